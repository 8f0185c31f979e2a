"""The summary of a class as one HTML page: no scripts, nothing from elsewhere, everything escaped."""
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from grader.marking.command.summary import Summary


def as_page(summary: Summary) -> str:
    """The whole page."""
    return _pages.get_template("summary.html").render(summary=summary).lstrip()


_pages = Environment(
    loader=FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    trim_blocks=True,
    lstrip_blocks=True,
    undefined=StrictUndefined,
)
_pages.filters["number"] = "{:g}".format
