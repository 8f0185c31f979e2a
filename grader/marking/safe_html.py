"""What of a submission's HTML may show in feedback pages and in the formgrader.

nbconvert's own filter drops the tables, pictures and folded hints that scores and tasks are made of, and
nbgrader's pages show Markdown unfiltered: a submission's script would run with the instructor's rights.
"""
import bleach
from bleach.css_sanitizer import CSSSanitizer

TEXT = "p h1 h2 h3 h4 h5 h6 br hr del s sub sup kbd small mark details summary pre div span"
TABLE = "table caption colgroup col thead tbody tfoot tr th td"
FIGURE = "img figure figcaption"
TAGS = {*bleach.ALLOWED_TAGS, *TEXT.split(), *TABLE.split(), *FIGURE.split()}
ATTRIBUTES = {
    **bleach.ALLOWED_ATTRIBUTES,
    "*": ["class", "id", "style", "title"],
    "a": ["href", "title", "name"],
    "img": ["src", "alt", "width", "height"],
    "td": ["colspan", "rowspan", "align"],
    "th": ["colspan", "rowspan", "align", "scope"],
}
# No `position`, nothing that reaches out of the cell or loads something.
TEXT_STYLES = "color font-family font-size font-style font-weight line-height text-align text-decoration"
BOX_STYLES = "background-color height max-width overflow overflow-x vertical-align white-space width"
SIDES = ("", "-top", "-right", "-bottom", "-left")
STYLES = {
    "border-collapse",
    *TEXT_STYLES.split(),
    *BOX_STYLES.split(),
    *(kind + side for kind in ("border", "margin", "padding") for side in SIDES),
}
PROTOCOLS = {"http", "https", "mailto", "data"}  # data: pictures inside the page

_cleaner = bleach.Cleaner(TAGS, ATTRIBUTES, PROTOCOLS, css_sanitizer=CSSSanitizer(STYLES))


def clean(html: object) -> str:
    """Return the HTML, with all that could run or leave its place escaped or dropped."""
    return _cleaner.clean(html.decode() if isinstance(html, bytes) else str(html))
