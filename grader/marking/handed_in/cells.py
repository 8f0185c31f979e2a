"""Reads the bytes of a notebook's file into plain cells, whatever has happened to the file.

Of every cell only its kind, its text and its names are kept. Outputs, counts, attachments, widgets and all
other metadata stay behind.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from grader.marking.errors import Unusable
from grader.marking.handed_in.salvage import read_table
from grader.marking.handed_in.words import kind_of_value, quote

MOST_CELLS = 1000
LONGEST_TEXT = 1_000_000  # characters of one cell
LONGEST_SUM = 5_000_000  # characters of all cells
DEFINITION = re.compile(r"^(?:(?:class|def|async def) |%%writefile +)(\S[^\s(:]*)", re.MULTILINE)
MOST_TOLD = 5
KINDS = ("code", "markdown", "raw")


@dataclass(frozen=True)
class Cell:
    """One cell. A kind, id or name that is missing or makes no sense is ""."""

    kind: str
    text: str
    id: str = ""
    name: str = ""  # nbgrader's grade_id
    settings: Mapping[str, Any] = field(default_factory=dict)  # nbgrader's metadata, of unchecked types
    skipped: bool = False  # tagged so that nbclient would not run it

    @cached_property
    def key(self) -> str:
        """Its text without what nobody sees: two cells with the same key say the same."""
        return "\n".join(line.rstrip() for line in self.text.strip().splitlines())

    @cached_property
    def lines(self) -> frozenset[str]:
        """Its lines, without indent and blank ones."""
        return frozenset(filter(None, map(str.strip, self.text.splitlines())))

    @cached_property
    def defined(self) -> frozenset[str]:
        """The names of the functions, classes and files that it makes."""
        return frozenset(DEFINITION.findall(self.text))


@dataclass(frozen=True)
class PlainNotebook:
    """The cells of a notebook, and a sentence for each thing that was odd about its file."""

    cells: list[Cell]
    repairs: list[str] = field(default_factory=list)


def read_notebook(data: bytes, file: str) -> PlainNotebook:
    """Read a notebook from the bytes of the file called `file`. Raises Unusable, and nothing else."""
    table, repairs = read_table(data, file)
    found = list(_raw_cells(table))
    if not found and not isinstance(table.get("cells"), list):
        problem = f"{quote(file)} holds no cells; expected a notebook."
        raise Unusable(f"{problem} Hand in the notebook's own file, as it lies in JupyterLab.")
    if len(found) > MOST_CELLS:
        problem = f"{quote(file)} has {len(found)} cells; at most {MOST_CELLS} can be marked."
        raise Unusable(f"{problem} Delete those that nobody needs and hand it in again.")
    version = table.get("nbformat")
    if version != 4:
        seen = quote(version) if isinstance(version, (int, float, str)) else "unknown"
        repairs.append(f"The notebook's format is {seen}; it was read as well as possible. Expected was `4`.")
    repairs += _language(table)
    cells, odd = _cells(found)
    repairs += odd
    if (total := sum(len(cell.text) for cell in cells)) > LONGEST_SUM:
        problem = f"The cells of {quote(file)} hold {total / 1e6:.1f} million characters of text;"
        raise Unusable(f"{problem} at most {LONGEST_SUM / 1e6:g} million can be marked. Make them shorter.")
    return PlainNotebook(cells, repairs)


def cell_of(raw: Mapping[str, Any], repairs: list[str] | None = None, number: int = 0) -> Cell:
    """Read one cell of a notebook; what was odd is told in `repairs`, where the cell is called `number`."""
    oddities = [] if repairs is None else repairs
    metadata = _table(raw.get("metadata"))
    settings = {key: value for key, value in _table(metadata.get("nbgrader")).items() if _plain(value)}
    tags = metadata.get("tags")
    return Cell(
        _kind(raw, oddities, number),
        _text(raw, oddities, number),
        _word(raw.get("id")),
        _word(settings.get("grade_id")),
        settings,
        isinstance(tags, list) and "skip-execution" in tags,
    )


def is_answer(cell: Cell) -> bool:
    """Whether students write in this cell of a release, and are marked for it."""
    return cell.settings.get("solution") is True


def is_test(cell: Cell) -> bool:
    """Whether this cell of a release gives points for an answer."""
    return cell.settings.get("grade") is True and not is_answer(cell)


def _raw_cells(table: Mapping[str, Any]) -> Iterator[Any]:
    """The cells of a notebook, those of the formats 2 and 3 too, which had them in worksheets."""
    places = [table, *_list(table.get("worksheets"))]
    for place in places:
        yield from _list(_table(place).get("cells"))


def _cells(found: list[Any]) -> tuple[list[Cell], list[str]]:
    oddities: list[str] = []
    cells = []
    for number, raw in enumerate(found, 1):
        if isinstance(raw, dict):
            cells.append(cell_of(raw, oddities, number))
        else:
            oddities.append(f"Cell {number} of the notebook is {kind_of_value(raw)}; it was left out.")
    if len(oddities) > MOST_TOLD:
        oddities[MOST_TOLD:] = [f"The notebook has {len(oddities) - MOST_TOLD} more such oddities."]
    return cells, oddities


def _kind(raw: Mapping[str, Any], oddities: list[str], number: int) -> str:
    kind = raw.get("cell_type")
    if kind in ("heading", "html"):  # of the formats 2 and 3
        return "markdown"
    if kind in KINDS:
        return kind
    saw = f"the unknown type {quote(kind)}" if isinstance(kind, str) else "no type"
    oddities.append(f"Cell {number} of the notebook has {saw}; it was read all the same.")
    return ""


def _text(raw: Mapping[str, Any], oddities: list[str], number: int) -> str:
    source = raw.get("source", raw.get("input", ""))  # formats 2 and 3: input
    lines = source if isinstance(source, list) else [source]
    if not all(isinstance(line, str) for line in lines):
        odd = next(line for line in lines if not isinstance(line, str))
        saw = f"{kind_of_value(odd)} for its text"
        oddities.append(f"Cell {number} of the notebook holds {saw}; that was left out.")
        lines = [line for line in lines if isinstance(line, str)]
    text = "".join(lines)
    if len(text) > LONGEST_TEXT:
        saw = f"{len(text) / 1e6:.1f} million characters, more than can be run"
        oddities.append(f"Cell {number} of the notebook holds {saw}; it counts as empty.")
        return ""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\0", "")
    return text.encode(errors="replace").decode()  # half a character, as only escapes can make it


def _language(table: Mapping[str, Any]) -> list[str]:
    metadata = _table(table.get("metadata"))
    kernel, language = _table(metadata.get("kernelspec")), _table(metadata.get("language_info"))
    name = _word(kernel.get("language")) or _word(language.get("name")) or "python"
    if name in ("python", "ipython") and kernel.get("name") != "python2":
        return []
    saw = _word(kernel.get("display_name")) or _word(kernel.get("name")) or name
    return [f"The notebook was saved for the kernel {quote(saw)}; it was run with Python 3."]


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _plain(value: Any) -> bool:
    return value is None or isinstance(value, (str, bool, int, float))


def _word(value: Any) -> str:
    return value if isinstance(value, str) else ""
