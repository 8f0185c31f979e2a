"""Reads a course from its files: notebooks with progress and points, chapters, dates, new versions."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

PART = re.compile(r"(\d\d)[a-z]?_(\w+)")  # a folder: 11_packages; its second assignment: 11b_launching
# Metadata in the text of a notebook's first cell.
# The number of one of several notebooks of a lesson, or of its several assignments.
HALF = re.compile(r"^# (?:Lesson|Assignment) (\d+[a-z]):", re.MULTILINE)
TIME = re.compile(r"\*\*Time:\*\*\s+([^.]+)\.")
NEEDS = re.compile(r"\*\*Before you begin:\*\*\s+((?:\]\([^)]*\)|[^.])+)\.")
LINK = re.compile(r"\[([^]]*)\]\([^)]*\)")
DONE = 0.9  # fraction of a lesson's cells that counts as done
DUE = "due.json"  # in course/; `python -m grader due` writes it
CHAPTERS = "chapters.json"  # in course/
FIRST = "lesson.ipynb"  # the first or only notebook of a lesson
PICTURE = "goal.svg"  # the goal of FIRST, beside it; that of driving.ipynb is driving.svg
FOLDERS = ("course", "exercises")
# A cell that calls one of these displays a run, or a source, which the student's process doesn't have.
DISPLAYS = {"run", "packages.see", "launching.see", "testing.see", "inspect.getsource"}
BRIDGE = "bridge"  # the folder of the pages after the lessons; each is a notebook
UPDATED = ".updated.txt"  # in the folder of the course; see work_folder.py
NEW_VERSION = "-new"  # suffix of a new version that was saved next to the student's file


@dataclass(frozen=True)
class Notebook:
    """The state of a lesson or an assignment in its file. A lesson has 0 of 0 points."""

    path: Path
    number: str  # of its lesson, such as "4" or "4b"; of a page of the bridge "B" and the page's number
    title: str
    time: str
    needs: str
    cells: int
    run: int
    points: float
    most: float
    due: str = ""  # of an assignment, in local time; "" if there is no date

    @property
    def name(self) -> str:
        """Its number, title and kind."""
        return f"{self.number} {self.title} ({self.kind})"

    @property
    def heading(self) -> str:
        """Its number and its title, which begins with a capital letter unless that is a program's name."""
        first = self.title if "_" in self.title.split()[0] else f"{self.title[:1].upper()}{self.title[1:]}"
        return f"{self.number} {first}"

    @property
    def kind(self) -> str:
        """ "lesson", "page" or "exercises"."""
        if self.path.parent.name == BRIDGE:
            return "page"
        return "exercises" if self.most else "lesson"

    @property
    def done(self) -> bool:
        """Return whether enough cells were run, or all points earned."""
        return self.points >= self.most if self.most else self.run >= DONE * self.cells > 0


@dataclass(frozen=True)
class CoursePart:
    """A lesson and its assignments, in folders with the same number: 11_packages, 11b_launching.

    name: the lesson's folder. picture: the SVG of the lesson's goal; "" if it has none. pages: those of the
    bridge that can be read after it.
    """

    name: str
    notebooks: tuple[Notebook, ...]
    picture: str = ""
    pages: tuple[Notebook, ...] = ()


@dataclass(frozen=True)
class Chapter:
    """Parts of the course that belong together."""

    title: str
    about: str
    parts: tuple[CoursePart, ...]


def read_chapters(file: Path) -> list[tuple[str, str, list[str]]]:
    """The title, the description and the names of the parts of each chapter."""
    try:
        data = json.loads(read_text(file))
        return [(str(each["title"]), str(each["about"]), [*map(str, each["parts"])]) for each in data]
    except (ValueError, TypeError, KeyError):
        return []


def read_offers(file: Path) -> dict[str, list[str]]:
    """The pages of the bridge that are offered after a part, by the part's name."""
    try:
        data = json.loads(read_text(file))
        offers = [offer for each in data for offer in each.get("pages", {}).items()]
        return {str(name): [*map(str, pages)] for name, pages in offers}
    except (ValueError, TypeError, AttributeError):
        return {}


def new_versions(root: Path) -> list[tuple[Path, Path]]:
    """Files that the student has changed, each with its new version, which is saved next to it."""
    found = [path for folder in FOLDERS for path in (root / folder).glob(f"*/*{NEW_VERSION}.*")]
    pairs = [(path.with_stem(path.stem.removesuffix(NEW_VERSION)), path) for path in sorted(found)]
    return [(own, new) for own, new in pairs if own.exists()]


def read_text(file: Path) -> str:
    """The text of a file; "" if it can't be read."""
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return ""


def read_due_dates(file: Path) -> dict[str, datetime]:
    """Return when the assignments are due (UTC), as the instructor wrote it."""
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
        return {name: datetime.fromisoformat(when) for name, when in data.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def read_notebooks(root: Path) -> Iterator[Notebook]:
    """Lessons and assignments in the order of the course."""
    found = [path for folder in FOLDERS for path in (root / folder).glob("*/*.ipynb")]
    found = [path for path in found if _is_part(path) and NEW_VERSION not in path.stem]
    for path in sorted(found, key=course_order):
        try:
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            yield _notebook(path, [cell | {"source": "".join(cell["source"])} for cell in cells])
        except (AttributeError, KeyError, OSError, TypeError, ValueError):
            continue  # invalid; JupyterLab reports it when it is opened


def course_order(path: Path) -> tuple[str, str, str, bool, str]:
    """Sorts notebooks: by lesson; the lesson before its assignments; of several notebooks FIRST first."""
    folder = path.parent
    return part_of(folder.name), folder.parent.name, folder.name, path.name != FIRST, path.name


def part_of(folder: str) -> str:
    """The number of a folder's lesson, which its assignments have, too; for the bridge its name."""
    found = PART.fullmatch(folder)
    return found[1] if found else folder


def picture_of(notebook: Path) -> Path:
    """The file with the picture of a lesson's goal."""
    return notebook.with_name(PICTURE) if notebook.name == FIRST else notebook.with_suffix(".svg")


def _is_part(path: Path) -> bool:
    """Return whether it is in a lesson's folder, or a page of the bridge."""
    numbered = path.stem if path.parent.name == BRIDGE else path.parent.name
    return PART.fullmatch(numbered) is not None


def _notebook(path: Path, cells: list[dict[str, Any]]) -> Notebook:
    text = "\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")
    code = [cell for cell in cells if cell["cell_type"] == "code" and cell["source"].strip()]
    tests = [cell for cell in code if cell["metadata"].get("nbgrader", {}).get("grade")]
    title = next(iter(re.findall(r"^# (?:.*?: )?(.+)$", text, re.MULTILINE)), path.stem)
    needs = f"lesson {int(path.parent.name[:2])}" if tests else ""
    return Notebook(
        path=path,
        number=_number(path, text),
        title=title,
        time=_phrase(TIME, text),
        needs=_phrase(NEEDS, text) or needs,
        cells=len(code),
        run=sum(cell.get("execution_count") is not None for cell in code),
        points=sum(map(_earned, tests)),
        most=sum(cell["metadata"]["nbgrader"].get("points", 0) for cell in tests),
    )


def _number(path: Path, text: str) -> str:
    folder = path.parent.name
    if folder == BRIDGE:
        return f"B{int(path.stem[:2])}"
    return _phrase(HALF, text) or str(int(folder[:2]))


def _phrase(pattern: re.Pattern[str], text: str) -> str:
    """The first match of the pattern, on one line and without links; "" without a match."""
    found = LINK.sub(r"\1", next(iter(pattern.findall(text)), ""))
    return " ".join(found.replace("`", "").split())


def _earned(cell: dict[str, Any]) -> float:
    """The points in the output of a test cell; 0 without a score."""
    most: float = cell["metadata"]["nbgrader"].get("points", 0)
    for output in cell.get("outputs", []):
        text = "".join(output.get("data", {}).get("text/plain", ""))
        if output["output_type"] == "execute_result" and re.fullmatch(r"\d+(\.\d+)?", text):
            return min(float(text), most)
    return 0.0
