"""The marks of a class that can be certified: those on which gradebook and journal agree."""
import hashlib
import json
import re
from collections.abc import Collection
from dataclasses import dataclass, field

from grader.marking.extras.certificate.certificate import Mark
from grader.marking.gradebook.book import Book, GradebookMark
from grader.marking.gradebook.course import Course
from grader.marking.journal import Journal
from grader.marking.progress_line import printable
from grader.marking.result import Result

HEADING = re.compile(r"^# +(.+?)\s*$", re.MULTILINE)
MAX_NAME_CHARS = 100  # characters


@dataclass
class StudentMarks:
    """A student's marks by assignment, and why other marks can't be certified."""

    name: str
    marks: dict[str, Mark] = field(default_factory=dict)
    doubts: dict[str, str] = field(default_factory=dict)


def read_marks(course: Course, students: Collection[str] = ()) -> dict[str, StudentMarks]:
    """The marks of all students, or of these. Raises GradebookError."""
    with Book(course) as book:
        marks = [mark for mark in book.marks() if not students or mark.student in students]
    titles = {assignment: _title(course, assignment) for assignment in {mark.assignment for mark in marks}}
    found: dict[str, StudentMarks] = {}
    for mark in marks:
        record = found.setdefault(mark.student, StudentMarks(printable(mark.name)[:MAX_NAME_CHARS]))
        entry = Journal(course.journal(mark.assignment)).last(mark.student)
        doubt = _doubt(mark, entry.result if entry else None)
        if entry is None or doubt:
            record.doubts[mark.assignment] = doubt
            continue
        digest = hashlib.sha256(entry.result.grade_json().encode()).hexdigest()
        title = titles[mark.assignment]
        record.marks[mark.assignment] = Mark(mark.assignment, title, mark.points, mark.most, digest)
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
