"""Reads the bytes of a notebook's file into plain cells, however damaged the file is.

Only the kind, text and names of each cell are read. Outputs, counts, attachments, widgets and all other
metadata are dropped.
"""

import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from grader.marking.errors import Unusable
from grader.marking.submission.quoting import kind_of_value, quote
from grader.marking.submission.recover_json import read_json_object

MAX_CELLS = 1000
MAX_CELL_CHARS = 1_000_000
MAX_CHARS = 5_000_000  # of all cells
DEFINITION = re.compile(r"^(?:(?:class|def|async def) |%%writefile +)(\S[^\s(:]*)", re.MULTILINE)
MAX_ODDITIES = 5
MAX_POINTS = 1e6
KINDS = ("code", "markdown", "raw")


@dataclass(frozen=True)
class Cell:
    """One cell. A kind, id or name that is missing or invalid is ""."""

    kind: str
    text: str
    id: str = ""
    name: str = ""  # nbgrader's grade_id
    settings: Mapping[str, Any] = field(default_factory=dict)  # nbgrader's metadata, of unchecked types
    skipped: bool = False  # tagged so that nbclient would not run it

    @cached_property
    def key(self) -> str:
        """Its text without invisible characters: cells with the same key have the same text."""
        return "\n".join(line.rstrip() for line in self.text.strip().splitlines())

    @property
    def checksum(self) -> str:
        """The checksum that nbgrader gives a released cell."""
        kinds = (str(self.settings.get(key)) for key in ("grade", "solution", "locked"))
        points = self.settings.get("points") if self.settings.get("grade") else None
        worth = str(float(points)) if isinstance(points, (int, float)) and abs(points) < MAX_POINTS else ""
        text = "".join([self.text, self.kind, *kinds, self.name, worth])
        return hashlib.md5(text.encode(errors="replace")).hexdigest()

    @cached_property
    def lines(self) -> frozenset[str]:
        """Its lines, without indent and blank ones."""
        return frozenset(filter(None, map(str.strip, self.text.splitlines())))

    @cached_property
    def defined(self) -> frozenset[str]:
        """The names of the functions, classes and files that it defines."""
        return frozenset(DEFINITION.findall(self.text))


@dataclass(frozen=True)
class PlainNotebook:
    """The cells of a notebook, and a sentence for each thing that was odd about its file."""

    cells: list[Cell]
    repairs: list[str] = field(default_factory=list)


def read_notebook(data: bytes, file: str) -> PlainNotebook:
    """Read a notebook from the bytes of the file called `file`. Raises Unusable, and nothing else."""
    content, repairs = read_json_object(data, file)
    found = list(_raw_cells(content))
    if not found and not isinstance(content.get("cells"), list):
        problem = f"{quote(file)} contains no cells; expected a notebook."
        raise Unusable(f"{problem} Hand in the notebook's own file, as JupyterLab saves it.")
    if len(found) > MAX_CELLS:
        problem = f"{quote(file)} has {len(found)} cells; at most {MAX_CELLS} can be marked."
        raise Unusable(f"{problem} Delete those that you don't need and hand it in again.")
    version = content.get("nbformat")
    if version != 4:
        seen = quote(version) if isinstance(version, (int, float, str)) else "unknown"
        repairs.append(f"The notebook's format is {seen}; it was read as well as possible. Expected was `4`.")
    repairs += _language(content)
    cells, odd = _cells(found)
    repairs += odd
    if (total := sum(len(cell.text) for cell in cells)) > MAX_CHARS:
        problem = f"The cells of {quote(file)} contain {total / 1e6:.1f} million characters of text;"
        raise Unusable(f"{problem} at most {MAX_CHARS / 1e6:g} million can be marked. Make them shorter.")
    return PlainNotebook(cells, repairs)


def cell_of(raw: Mapping[str, Any], repairs: list[str] | None = None, number: int = 0) -> Cell:
    """Read one cell. repairs: gets a sentence on each odd thing in it, where the cell has this number."""
    oddities = [] if repairs is None else repairs
    metadata = _dict(raw.get("metadata"))
    settings = {key: value for key, value in _dict(metadata.get("nbgrader")).items() if _is_scalar(value)}
    tags = metadata.get("tags")
    return Cell(
        _kind(raw, oddities, number),
        _text(raw, oddities, number),
        _str(raw.get("id")),
        _str(settings.get("grade_id")),
        settings,
        isinstance(tags, list) and "skip-execution" in tags,
    )


def is_answer(cell: Cell) -> bool:
    """Return whether students write in this cell of a release, and are marked for it."""
    return cell.settings.get("solution") is True


def is_test(cell: Cell) -> bool:
    """Return whether this cell of a release is a test that gives points."""
    return cell.settings.get("grade") is True and not is_answer(cell)


def _raw_cells(content: Mapping[str, Any]) -> Iterator[Any]:
    """The cells of a notebook, also of the formats 2 and 3, which had them in worksheets."""
    for sheet in [content, *_list(content.get("worksheets"))]:
        yield from _list(_dict(sheet).get("cells"))


def _cells(found: list[Any]) -> tuple[list[Cell], list[str]]:
    oddities: list[str] = []
    cells = []
    for number, raw in enumerate(found, 1):
        if isinstance(raw, dict):
            cells.append(cell_of(raw, oddities, number))
        else:
            oddities.append(f"Cell {number} of the notebook is {kind_of_value(raw)}; it was left out.")
    if len(oddities) > MAX_ODDITIES:
        oddities[MAX_ODDITIES:] = [f"The notebook has {len(oddities) - MAX_ODDITIES} more such oddities."]
    return cells, oddities


def _kind(raw: Mapping[str, Any], oddities: list[str], number: int) -> str:
    kind = raw.get("cell_type")
    if kind in ("heading", "html"):  # of the formats 2 and 3
        return "markdown"
    if kind in KINDS:
        return str(kind)
    saw = f"the unknown type {quote(kind)}" if isinstance(kind, str) else "no type"
    oddities.append(f"Cell {number} of the notebook has {saw}; it was read anyway.")
    return ""


def _text(raw: Mapping[str, Any], oddities: list[str], number: int) -> str:
    source = raw.get("source", raw.get("input", ""))  # formats 2 and 3: input
    lines = source if isinstance(source, list) else [source]
    if not all(isinstance(line, str) for line in lines):
        odd = next(line for line in lines if not isinstance(line, str))
        saw = f"{kind_of_value(odd)} for its text"
        oddities.append(f"Cell {number} of the notebook contains {saw}; that was left out.")
        lines = [line for line in lines if isinstance(line, str)]
    text = "".join(lines)
    if len(text) > MAX_CELL_CHARS:
        saw = f"{len(text) / 1e6:.1f} million characters, more than can be run"
        oddities.append(f"Cell {number} of the notebook contains {saw}; it counts as empty.")
        return ""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\0", "")
    return text.encode(errors="replace").decode()  # half a character, as only escapes can make it


def _language(content: Mapping[str, Any]) -> list[str]:
    metadata = _dict(content.get("metadata"))
    kernel, language = _dict(metadata.get("kernelspec")), _dict(metadata.get("language_info"))
    name = _str(kernel.get("language")) or _str(language.get("name")) or "python"
    if name in ("python", "ipython") and kernel.get("name") != "python2":
        return []
    saw = _str(kernel.get("display_name")) or _str(kernel.get("name")) or name
    return [f"The notebook was saved for the kernel {quote(saw)}; it was run with Python 3."]


def _dict(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _is_scalar(value: Any) -> bool:
    return value is None or isinstance(value, (str, bool, int, float))


def _str(value: Any) -> str:
    return value if isinstance(value, str) else ""
