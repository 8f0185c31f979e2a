"""Sample submissions made from a course's own solutions: all right, half right, and the untouched starter."""
import copy
import math
from pathlib import Path

import nbformat
from nbformat import NotebookNode

SHARES = {"right": 1.0, "half_right": 0.5, "wrong": 0.0}


def submission(solution: NotebookNode, starter: NotebookNode, share: float) -> NotebookNode:
    """Return the starter with the first `share` (0..1, rounded up) of its answers from the solution."""
    answers = {_grade_id(cell): cell.source for cell in solution.cells if _is_answer(cell)}
    notebook = copy.deepcopy(starter)
    blanks = [cell for cell in notebook.cells if _is_answer(cell)]
    for cell in blanks[: math.ceil(share * len(blanks))]:
        cell.source = answers[_grade_id(cell)]
    return notebook


def submit_samples(course: Path, assignment: str) -> None:
    """Write the samples' submissions of a released assignment into course/class/submitted."""
    for starter in sorted((course / "exercises" / assignment).glob("*.ipynb")):
        solution = course / "solutions" / assignment / starter.name
        for student, share in SHARES.items():
            target = course / "class" / "submitted" / student / assignment / starter.name
            target.parent.mkdir(parents=True, exist_ok=True)
            nbformat.write(submission(nbformat.read(solution, 4), nbformat.read(starter, 4), share), target)


def _is_answer(cell: NotebookNode) -> bool:
    return bool(cell.metadata.get("nbgrader", {}).get("solution", False))


def _grade_id(cell: NotebookNode) -> str:
    return str(cell.metadata.nbgrader.grade_id)
