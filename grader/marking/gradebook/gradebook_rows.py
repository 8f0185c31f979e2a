"""Students and marks, as the gradebook has them."""
from dataclasses import dataclass

from nbgrader.api import SubmittedAssignment


@dataclass(frozen=True)
class GradebookMark:
    """A student's mark for an assignment in the gradebook.

    name: first and last, or the id. points: with points entered by hand, after the penalty for being late.
    by_marking: the points of each test cell, by notebook and cell; None if it was not marked.
    """

    student: str
    name: str
    assignment: str
    points: float
    most: float
    by_marking: dict[tuple[str, str], float | None]
    needs_look: bool
    penalty: float


@dataclass(frozen=True)
class GradebookStudent:
    """A student of the class, with what the gradebook knows of the name."""

    student: str
    first: str
    last: str
    mail: str


def read_mark(found: SubmittedAssignment) -> GradebookMark:
    """The mark of a submission."""
    who = found.student
    cells = {(note.name, grade.name): grade.auto_score for note in found.notebooks for grade in note.grades}
    penalty = found.late_submission_penalty or 0.0
    return GradebookMark(
        student=who.id,
        name=" ".join(part for part in (who.first_name, who.last_name) if part) or who.id,
        assignment=found.assignment.name,
        points=max(0.0, found.score - penalty),
        most=found.max_score,
        by_marking=cells,
        needs_look=bool(found.needs_manual_grade),
        penalty=penalty,
    )
