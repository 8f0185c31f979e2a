"""Checks that solutions, release and gradebook agree, before an assignment is marked."""
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import nbformat
from nbformat import NotebookNode
from nbgrader.converters import GenerateAssignment
from nbgrader.preprocessors import InstantiateTests, SaveCells
from nbgrader.utils import is_grade

from grader.marking import secret
from grader.marking.errors import CourseError, NoVariants
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.find_submissions import REMAKE
from grader.marking.judge import testcells
from grader.marking.judge.personal_release import NO_SECRET, has_variants

HIDDEN = "### BEGIN HIDDEN TESTS"


def check_release(course: Course, assignment: str, known: Mapping[tuple[str, str], float] | None) -> None:
    """Raise CourseError unless solutions, release and gradebook agree, and the tests can be marked here.

    known: the points of the test cells in the gradebook, by notebook and cell; None if it has no entry.
    """
    if known is None:
        raise CourseError(f"the gradebook doesn't know {assignment}: {REMAKE}")
    found: dict[tuple[str, str], float] = {}
    for path in sorted(course.release(assignment).glob("*.ipynb")):
        notebook = nbformat.read(path, 4)
        testcells.exercise_names(notebook)
        if has_variants([notebook]) and not secret.read(course.root):
            raise NoVariants(NO_SECRET.format(assignment))
        cells = [cell.metadata.nbgrader for cell in notebook.cells if is_grade(cell)]
        found |= {(path.stem, cell.grade_id): float(cell.points) for cell in cells}
        source = course.source(assignment) / path.name
        if source.exists() and _content(notebook) != _content(_released(course, source)):
            file = path.relative_to(course.root)
            raise CourseError(f"{file} is not what solutions/ produces now: {REMAKE}, or undo the changes to "
                              "solutions/")
    for notebook, cell in sorted(found.keys() ^ known.keys()):
        here = "exercises/" if (notebook, cell) in found else "the gradebook"
        raise CourseError(f"the test cell {cell} of {notebook}.ipynb is only in {here}: {REMAKE}")
    for (notebook, cell), points in found.items():
        if points != known[notebook, cell]:
            gives = f"gives {points:g} points, and {known[notebook, cell]:g} in the gradebook"
            raise CourseError(f"the test cell {cell} of {notebook}.ipynb {gives}: {REMAKE}")


def _released(course: Course, source: Path) -> NotebookNode:
    """The release that nbgrader makes of a notebook with answers, without entering it into the gradebook."""
    converter = GenerateAssignment(coursedir=course.directory, parent=course.app)
    notebook: NotebookNode = nbformat.read(source, 4)
    if any(HIDDEN in cell.source for cell in notebook.cells):
        file = source.relative_to(course.root)
        raise CourseError(f"{file} has hidden tests, which only `nbgrader autograde` runs: show these tests")
    resources = {"nbgrader": {"assignment": source.parent.name}, "unique_key": source.stem}
    for step in converter.preprocessors:
        if step not in (SaveCells, InstantiateTests):
            notebook, resources = step(parent=converter)(notebook, resources)
    return notebook


def _content(notebook: NotebookNode) -> list[tuple[str, str, Any]]:
    """Return what must agree in each cell, but for the checksum, which covers the answer or the task."""
    return [
        (cell.cell_type, cell.source, {**cell.metadata.get("nbgrader", {}), "checksum": ""})
        for cell in notebook.cells
    ] + [("variants", "", has_variants([notebook]))]
