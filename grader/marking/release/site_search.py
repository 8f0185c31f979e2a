"""What the site's search needs in a folder: the texts of the pages, and which lesson explains a term."""
import json
import re
from collections.abc import Iterable
from importlib.resources import files
from pathlib import Path

import nbformat

from grader.course_files.course_notebooks import read_text

TERM = re.compile(r"^\| \*\*(.+?)\*\* \|.*\| ([\d, ]+) \|$", re.MULTILINE)  # a row of glossary.md
_FORMULAS, _RULES = r"\$\$.*?\$\$|\$[^$\n]+\$", r"^[|\s:-]*--[|\s:-]*$"  # the rules are of tables
MARKUP = re.compile(
    rf"```.*?```|{_FORMULAS}|<[^>]+>|!?\[|\]\([^)]*\)|{_RULES}|[*`#|]", re.DOTALL | re.MULTILINE
)


def search_script(folder: Path, pages: Iterable[str]) -> str:
    """The script that the search page loads first. pages: paths in the folder, without their endings."""
    texts = {page: " ".join(MARKUP.sub(" ", _text(folder / page)).split()) for page in pages}
    rows = TERM.findall(read_text(folder / "course" / "glossary.md"))
    data = {"TEXTS": texts, "TERMS": {term.lower(): int(numbers.split(",")[0]) for term, numbers in rows}}
    constants = "".join(f"const {name} = {json.dumps(value)};\n" for name, value in data.items())
    return constants + files("grader.marking.release").joinpath("site_search.js").read_text(encoding="utf-8")


def _text(page: Path) -> str:
    """The text of a page: of a notebook that of its cells with text."""
    if not (notebook := page.with_suffix(".ipynb")).exists():
        return read_text(page.with_suffix(".md"))
    cells = nbformat.read(notebook, 4).cells
    return "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
