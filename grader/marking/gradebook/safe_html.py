"""Cleans the HTML of submissions for feedback pages and the formgrader.

nbconvert's own filter drops the tables, pictures and folded hints that scores and tasks consist of, and
nbgrader's pages show Markdown unfiltered: a submission's script would run with the instructor's rights.

A replay or a plot is data in a `div` and a script that draws it. The data is allowed from any source, because
the script only draws its numbers; every script is dropped, and the course's own one is added.
"""

import re
from collections.abc import Callable
from typing import Any

import nh3
from jinja2 import pass_context
from jinja2.runtime import Context
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

from grader.marking.gradebook.short_pages import TOO_LONG, too_long

WORDS = "a abbr acronym b blockquote code em i li ol strong ul"
TEXT = "p h1 h2 h3 h4 h5 h6 br hr del s sub sup kbd small mark details summary pre div span"
TABLE = "table caption colgroup col thead tbody tfoot tr th td"
FIGURE = "img figure figcaption"
TAGS = {*WORDS.split(), *TEXT.split(), *TABLE.split(), *FIGURE.split()}
# No `id`: the formgrader finds its buttons and fields by ids, which a cell could imitate.
ATTRIBUTES = {
    "*": {"class", "style", "title"},
    "a": {"href"},
    "div": {"data-replay", "data-plot"},
    "img": {"alt", "width", "height", "src"},
    "td": {"colspan", "rowspan", "align"},
    "th": {"colspan", "rowspan", "align", "scope"},
}
# No `position`, nothing that extends beyond the cell or loads something.
TEXT_STYLES = "color font-family font-size font-style font-weight line-height text-align text-decoration"
BOX_STYLES = "background-color height max-width overflow overflow-x vertical-align white-space width"
SIDES = ("", "-top", "-right", "-bottom", "-left")
STYLES = {
    "border-collapse",
    *TEXT_STYLES.split(),
    *BOX_STYLES.split(),
    *(kind + side for kind in ("border", "margin", "padding") for side in SIDES),
}
PROTOCOLS = {"http", "https", "mailto", "data"}  # data: pictures inside the page, and nothing else
LINK = re.compile(r"(https?://|mailto:|#).*", re.DOTALL)
# Of pictures: embedded ones only. One from this server could trigger an action, such as /hub/logout; one from
# another server would tell it who reads the page.
INSIDE = re.compile(r"data:image/(png|jpeg|gif|webp|svg\+xml);base64,[A-Za-z0-9+/=\s]*")
LENGTH = r"(\d*\.?\d+(px|em|ex|rem|ch|pt|%)?|auto)"  # with a minus, it would cover what is not its own
MARGIN = re.compile(rf"\s*{LENGTH}(\s+{LENGTH}){{0,3}}\s*")

# Of replays, tables and highlighted code. The pages' own style sheet has others that cover the page.
CLASSES = re.compile(r"ros2-replay|ros2-plot|dataframe|highlight|anchor-link|[a-z]{1,2}\d?|hll|err|esc")
REPLAY = re.compile(r"[A-Za-z0-9+/]{1,400000}={0,2}")  # its data: base64, so many characters at most
PICTURE = {"width": int, "height": int, "alt": str}  # pixels, words
RUNS = {"application/javascript", "application/vnd.jupyter.widget-view+json", "text/vnd.mermaid"}
# Up to the end of the text if the end tag is missing, as in browsers: one pass for any input.
UNSEEN = re.compile(r"<(script|style)\b.*?(</\1[^<>]*>?|\Z)", re.IGNORECASE | re.DOTALL)


def clean(html: object) -> str:
    """Return the HTML without anything that could run or cover the page."""
    text = html.decode(errors="replace") if isinstance(html, bytes) else str(html)
    seen = UNSEEN.sub("", text)
    return f"<p>{TOO_LONG}</p>" if too_long(seen) else _cleaner.clean(seen)


def clean_output(html: object) -> str:
    """The same for a cell's output; the course's own scripts are added if it has a replay or a plot."""
    safe = clean(html)
    if "data-replay=" in safe:
        from sim.view.replay import PLAYER_SCRIPT

        safe += f"<script>{PLAYER_SCRIPT}</script>"
    if "data-plot=" in safe:
        from sim.view.interactive import plot_script

        safe += f"<script>{plot_script()}</script>"
    return safe


class Attachments(dict[str, Any]):
    """The attached pictures of a Markdown cell. A missing one shows its description and raises nothing."""

    def __contains__(self, name: object) -> bool:
        return True

    def __getitem__(self, name: str) -> dict[str, str]:
        return self.get(name) or {"image/png": ""}


@pass_context
def markdown(context: Context, source: str) -> str:
    """A filter of nbconvert: converts Markdown to HTML, before `clean`. A picture may be missing."""
    cell = context.get("cell") or {}
    renderer = IPythonRenderer(escape=False, attachments=Attachments(cell.get("attachments") or {}))
    return MarkdownWithMath(renderer=renderer).render(source)


def plain_outputs(notebook: Any, resources: Any) -> tuple[Any, Any]:
    """A preprocessor of nbconvert: drops active content, and metadata except pictures' size and text.

    The templates write a size without quotes, so that any other value could become a script.
    """
    notebook.metadata.pop("widgets", None)
    for output in (output for cell in notebook.cells for output in cell.get("outputs", ())):
        if "data" in output:
            output["data"] = {kind: data for kind, data in output["data"].items() if kind not in RUNS}
            output["metadata"] = {
                kind: {key: value for key, value in settings.items() if type(value) is PICTURE.get(key)}
                for kind, settings in output.get("metadata", {}).items()
                if kind.startswith("image/") and isinstance(settings, dict)
            }
    return notebook, resources


def _kept(tag: str, name: str, value: str) -> str | None:
    """The value of an allowed attribute, or None."""
    holds: dict[str, Callable[[], object]] = {
        "class": lambda: all(CLASSES.fullmatch(word) for word in value.split()),
        "data-replay": lambda: REPLAY.fullmatch(value),
        "data-plot": lambda: REPLAY.fullmatch(value),
        "href": lambda: LINK.fullmatch(value),
        "src": lambda: INSIDE.fullmatch(value),
    }
    if name == "style":
        return ";".join(rule for rule in value.split(";") if _stays(rule)) or None
    return value if name not in holds or holds[name]() else None


def _stays(rule: str) -> bool:
    """Return whether a CSS rule such as "margin: 1em" moves nothing over the page."""
    name, _, value = rule.partition(":")
    return not name.strip().lower().startswith("margin") or bool(MARGIN.fullmatch(value))


_cleaner = nh3.Cleaner(
    tags=TAGS,
    attributes=ATTRIBUTES,
    attribute_filter=_kept,
    url_schemes=PROTOCOLS,
    filter_style_properties=STYLES,
    link_rel=None,
)
