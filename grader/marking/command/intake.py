"""What was handed in of an assignment, and whether the assignment can be marked at all."""
import difflib
import hashlib
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode
from nbgrader.converters import GenerateAssignment
from nbgrader.preprocessors import InstantiateTests, SaveCells
from nbgrader.utils import is_grade

from grader.marking.errors import CourseError
from grader.marking.gradebook.course import Course
from grader.marking.judge import testcells
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder, submission_key
from grader.marking.task import MarkingTask
from grader.marking.version import code_version

REMAKE = "run `make exercises`, which makes exercises/ from solutions/ and enters it into the gradebook"


def find_submissions(course: Course, assignment: str, chosen: Collection[str] = ()) -> dict[str, Path]:
    """The folders handed in for an assignment, sorted by student; only those of the chosen, if any.

    Raises CourseError where there is no such assignment, no such student, or no submission.
    """
    names = course.assignments()
    if assignment not in names:
        released = f"{course.release(assignment).parent} has no assignment {assignment}"
        known = f"there are {', '.join(names)}" if names else REMAKE
        raise CourseError(f"{released}: {_near(assignment, names) or known}")
    found = course.students(assignment)
    place = course.submitted("STUDENT", assignment)
    if not found:
        raise CourseError(f"nobody has handed in {assignment}: put the notebooks into {place}")
    for student in chosen:
        if student not in found:
            here = course.submitted(student, assignment)
            advice = _near(student, found) or f"{len(found)} students have handed it in"
            raise CourseError(f"{student} has not handed in {assignment}, {here} is missing: {advice}")
    return {student: folder for student, folder in sorted(found.items()) if not chosen or student in chosen}


class TaskReader:
    """Reads submissions for `release`, each into a task: what its key names is what will be marked."""

    def __init__(self, release: Release, secret: str = "") -> None:
        self.release = release
        self._fingerprint, self._version = hashlib.sha256(secret.encode()).hexdigest(), code_version()

    def read(self, student: str, folder: Path) -> MarkingTask:
        """The task of marking what lies in a student's folder now. Raises nothing for whatever lies there."""
        submitted = read_folder(folder, self.release)
        key = submission_key(submitted, self.release, self._fingerprint, self._version)
        return MarkingTask(student, self.release, submitted, key)


def check_release(course: Course, assignment: str, known: Mapping[tuple[str, str], float] | None) -> None:
    """Raise CourseError unless solutions, release and gradebook agree, and the tests can be marked here.

    known: the points of the test cells in the gradebook, by notebook and cell; None where it has no entry.
    """
    if known is None:
        raise CourseError(f"the gradebook doesn't know {assignment}: {REMAKE}")
    found: dict[tuple[str, str], float] = {}
    for path in sorted(course.release(assignment).glob("*.ipynb")):
        notebook = nbformat.read(path, 4)
        testcells.exercise_names(notebook)
        cells = [cell.metadata.nbgrader for cell in notebook.cells if is_grade(cell)]
        found |= {(path.stem, cell.grade_id): float(cell.points) for cell in cells}
        source = course.source(assignment) / path.name
        if source.exists() and _content(notebook) != _content(_released(course, source)):
            file = path.relative_to(course.root)
            raise CourseError(f"{file} is not what solutions/ gives now: {REMAKE}, or take solutions/ back")
    for notebook, cell in sorted(found.keys() ^ known.keys()):
        here = "exercises/" if (notebook, cell) in found else "the gradebook"
        raise CourseError(f"the test cell {cell} of {notebook}.ipynb is only in {here}: {REMAKE}")
    for (notebook, cell), points in found.items():
        if points != known[notebook, cell]:
            gives = f"gives {points:g} points, and {known[notebook, cell]:g} in the gradebook"
            raise CourseError(f"the test cell {cell} of {notebook}.ipynb {gives}: {REMAKE}")


def _released(course: Course, source: Path) -> NotebookNode:
    """What nbgrader makes of a notebook with answers, without entering it into the gradebook."""
    converter = GenerateAssignment(coursedir=course.directory, parent=course.app)
    notebook, resources = nbformat.read(source, 4), {"nbgrader": {}, "unique_key": source.stem}
    for step in converter.preprocessors:
        if step not in (SaveCells, InstantiateTests):
            notebook, resources = step(parent=converter)(notebook, resources)
    return notebook


def _content(notebook: NotebookNode) -> list[tuple[str, str, Any]]:
    """What counts of each cell: a checksum is of the answer in one and of the task in the other."""
    return [
        (cell.cell_type, cell.source, {**cell.metadata.get("nbgrader", {}), "checksum": ""})
        for cell in notebook.cells
    ]


def _near(name: str, names: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, list(names), n=1)
    return f"did you mean {near[0]}?" if near else ""
