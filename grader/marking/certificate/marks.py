"""The marks of a class that can be certified: gradebook and journal have them, and agree."""
import hashlib
import json
import re
from collections.abc import Collection
from dataclasses import dataclass, field

from grader.marking.certificate.certificate import Mark
from grader.marking.gradebook.book import Book, GradebookMark
from grader.marking.gradebook.course import Course
from grader.marking.journal import Journal
from grader.marking.progress_line import printable
from grader.marking.result import Result

HEADING = re.compile(r"^# +(.+?)\s*$", re.MULTILINE)
LONGEST_NAME = 100  # characters


@dataclass
class Standing:
    """A student: the marks by assignment, and why those that can't be certified can't be."""

    name: str
    marks: dict[str, Mark] = field(default_factory=dict)
    doubts: dict[str, str] = field(default_factory=dict)


def read_standings(course: Course, students: Collection[str] = ()) -> dict[str, Standing]:
    """The standing of all students, or of these. Raises GradebookError."""
    with Book(course) as book:
        marks = [mark for mark in book.marks() if not students or mark.student in students]
    titles = {assignment: _title(course, assignment) for assignment in {mark.assignment for mark in marks}}
    found: dict[str, Standing] = {}
    for mark in marks:
        standing = found.setdefault(mark.student, Standing(printable(mark.name)[:LONGEST_NAME]))
        entry = Journal(course.journal(mark.assignment)).last(mark.student)
        doubt = _doubt(mark, entry.result if entry else None)
        if entry is None or doubt:
            standing.doubts[mark.assignment] = doubt
            continue
        digest = hashlib.sha256(entry.result.grade_json().encode()).hexdigest()
        title = titles[mark.assignment]
        standing.marks[mark.assignment] = Mark(mark.assignment, title, mark.points, mark.most, digest)
    return dict(sorted(found.items()))


def _doubt(mark: GradebookMark, result: Result | None) -> str:
    """Why a mark can't be certified, or ""."""
    if result is None:
        return f"was not marked by `python -m grader mark {mark.assignment}`"
    earned = {(note.name, cell.cell): cell.points for note in result.notebooks for cell in note.cells}
    if any(mark.by_marking.get(cell) != points for cell, points in earned.items()):
        return f"has other points in the gradebook than marking gave: mark {mark.assignment} again"
    return "still needs a look in the formgrader" if mark.needs_look else ""


def _title(course: Course, assignment: str) -> str:
    """The heading of the assignment's first notebook, or its name."""
    for path in sorted(course.release(assignment).glob("*.ipynb")):
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            if found := HEADING.search("".join(cell["source"])) if cell["cell_type"] == "markdown" else None:
                return found[1].replace("`", "")
    return assignment
