"""The course map: all notebooks with their time, progress and points, and the next one.

Everything is read from the saved notebooks; no other state is stored.
"""

from __future__ import annotations

import html
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from grader.local_time import format_local
from grader.page import format_points

PART = re.compile(r"(\d\d)_(\w+)")
# Metadata in the text of a notebook's first cell.
TIME = re.compile(r"\*\*Time:\*\*\s+([^.]+)\.")
NEEDS = re.compile(r"\*\*Before you begin:\*\*\s+([^.]+)\.")
DONE = 0.9  # fraction of a lesson's cells that counts as done
DUE = "due.json"  # in course/; `python -m grader due` writes it
NEW_VERSION = "-new"  # suffix of a new version that was saved next to the student's file


@dataclass(frozen=True)
class Notebook:
    """The state of a lesson or an assignment in its file. A lesson has 0 of 0 points."""

    path: Path
    title: str
    time: str
    needs: str
    cells: int
    run: int
    points: float
    most: float

    @property
    def done(self) -> bool:
        """Whether enough cells were run, or all points earned."""
        return self.points >= self.most if self.most else self.run >= DONE * self.cells > 0


class CourseMap:
    """The course map: in Jupyter a table with links, in a terminal lines of text; see `course_map`."""

    def __init__(self, root: Path, here: Path) -> None:
        self._root, self._here = root, here
        self.notebooks = list(_notebooks(root))
        self._due = _due_dates(root / "course" / DUE)

    @property
    def next(self) -> Notebook | None:
        """The first notebook that is not done; None if all are."""
        return next((notebook for notebook in self.notebooks if not notebook.done), None)

    def __repr__(self) -> str:
        lines = [f"{self._name(item)}, {self._state(item)}" for item in self.notebooks]
        return "\n".join([*lines, self._points(), *([f"Next: {self._name(self.next)}"] if self.next else [])])

    def _repr_html_(self) -> str:
        cell = "text-align: left; vertical-align: top"
        heads = ("Notebook", "Time", "Needs", "So far")
        head = "".join(f'<th scope="col" style="{cell}">{word}</th>' for word in heads)
        rows = ""
        for item in self.notebooks:
            words = (html.escape(item.time), html.escape(item.needs), self._state(item))
            rows += f'<tr><td style="{cell}">{self._link(item)}</td>'
            rows += "".join(f'<td style="{cell}">{word}</td>' for word in words) + "</tr>"
        return (
            f"<p>{self._next_step()}</p><table><caption>{self._points()}</caption>"
            f"<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        )

    def _next_step(self) -> str:
        if self.next is None:
            return "<b>You have done all of it.</b>"
        time = f", {html.escape(self.next.time)}" if self.next.time else ""
        return f"<b>Next step: {self._link(self.next)}</b>{time}."

    def _points(self) -> str:
        earned, most = (sum(getattr(item, name) for item in self.notebooks) for name in ("points", "most"))
        return f"Your points so far: {format_points(earned)} of {format_points(most)}"

    def _link(self, item: Notebook) -> str:
        up = len(self._here.relative_to(self._root).parts)
        address = "../" * up + item.path.relative_to(self._root).as_posix()
        return f'<a href="{html.escape(address)}">{html.escape(self._name(item))}</a>'

    def _name(self, item: Notebook) -> str:
        kind = "exercises" if item.most else "lesson"
        return f"{int(item.path.parent.name[:2])} {item.title} ({kind})"

    def _state(self, item: Notebook) -> str:
        if item.most:
            due = self._due.get(item.path.parent.name)
            until = f", due {format_local(due)}" if due else ""
            return f"{format_points(item.points)} of {format_points(item.most)} points{until}"
        return "✔ done" if item.done else f"{item.run} of {item.cells} cells run"


def course_map(here: Path | str | None = None) -> CourseMap:
    """The map of the course that contains the folder `here`, by default the notebook's folder.

    Raises LookupError if it is not in a course.
    """
    here = Path(here or Path.cwd()).resolve()
    for root in (here, *here.parents):
        if (root / "course").is_dir() and (root / "exercises").is_dir():
            return CourseMap(root, here)
    raise LookupError(f"{here} is not in the course: expected a folder with course/ and exercises/ above it.")


def _due_dates(file: Path) -> dict[str, datetime]:
    """When the assignments are due (UTC), as the instructor wrote it."""
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
        return {name: datetime.fromisoformat(when) for name, when in data.items()}
    except (OSError, ValueError, TypeError, AttributeError):
        return {}


def _notebooks(root: Path) -> Iterator[Notebook]:
    """Lessons and assignments in the order of the course."""
    found = [path for folder in ("course", "exercises") for path in (root / folder).glob("*/*.ipynb")]
    found = [path for path in found if PART.fullmatch(path.parent.name) and NEW_VERSION not in path.stem]
    for path in sorted(found, key=lambda path: (path.parent.name, path.parent.parent.name, path.name)):
        try:
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            yield _notebook(path, [cell | {"source": "".join(cell["source"])} for cell in cells])
        except (AttributeError, KeyError, OSError, TypeError, ValueError):
            continue  # invalid; JupyterLab reports it when it is opened


def _notebook(path: Path, cells: list[dict[str, Any]]) -> Notebook:
    text = "\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")
    code = [cell for cell in cells if cell["cell_type"] == "code" and cell["source"].strip()]
    tests = [cell for cell in code if cell["metadata"].get("nbgrader", {}).get("grade")]
    title = next(iter(re.findall(r"^# (?:.*?: )?(.+)$", text, re.MULTILINE)), path.stem)
    needs = f"lesson {int(path.parent.name[:2])}" if tests else ""
    return Notebook(
        path=path,
        title=title,
        time=_phrase(TIME, text),
        needs=_phrase(NEEDS, text) or needs,
        cells=len(code),
        run=sum(cell.get("execution_count") is not None for cell in code),
        points=sum(map(_earned, tests)),
        most=sum(cell["metadata"]["nbgrader"].get("points", 0) for cell in tests),
    )


def _phrase(pattern: re.Pattern[str], text: str) -> str:
    """The first match of the pattern, on one line; "" without a match."""
    return " ".join(next(iter(pattern.findall(text)), "").replace("`", "").split())


def _earned(cell: dict[str, Any]) -> float:
    """The points in the output of a test cell; 0 without a score."""
    most = cell["metadata"]["nbgrader"].get("points", 0)
    for output in cell.get("outputs", []):
        text = "".join(output.get("data", {}).get("text/plain", ""))
        if output["output_type"] == "execute_result" and re.fullmatch(r"\d+(\.\d+)?", text):
            return min(float(text), most)
    return 0.0
