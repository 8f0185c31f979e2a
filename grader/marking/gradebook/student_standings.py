"""What the gradebook says of students who were marked: points and comments by hand, lateness, penalties."""
import hashlib
from collections.abc import Collection, Iterable, Mapping
from dataclasses import astuple, dataclass
from datetime import datetime
from typing import Any

from nbgrader.api import Gradebook, SubmittedAssignment, SubmittedNotebook
from nbgrader.apps import NbGrader
from nbgrader.preprocessors import AssignLatePenalties

from grader.marking.lateness import DAY_S

Cell = tuple[str, str]  # notebook and name


@dataclass(frozen=True)
class Standing:
    """A student's standing in an assignment.

    points: of each graded cell as they count, None where they are still missing. by_hand: the cells whose
    points an instructor gave. comments: an instructor's, by cell. penalty: points lost by being late.
    days_late: days after the due date, with the student's extension.
    """

    points: dict[Cell, float | None]
    by_hand: frozenset[Cell] = frozenset()
    comments: tuple[tuple[Cell, str], ...] = ()
    penalty: float = 0.0
    days_late: float = 0.0

    @property
    def digest(self) -> str:
        """Identifies it; it changes when the student's page has to."""
        points, by_hand, *rest = astuple(self)
        return hashlib.sha256(repr((sorted(points.items()), sorted(by_hand), *rest)).encode()).hexdigest()


def read_standings(submissions: Iterable[SubmittedAssignment]) -> dict[str, Standing]:
    """The standings by student."""
    return {found.student.id: _standing(found) for found in submissions}


def _standing(found: SubmittedAssignment) -> Standing:
    grades = [(note.name, grade) for note in found.notebooks for grade in note.grades]
    comments = [
        ((note.name, each.name), each.manual_comment)
        for note in found.notebooks
        for each in note.comments
        if each.manual_comment
    ]
    return Standing(
        {(name, each.name): _points(each) for name, each in grades},
        frozenset((name, each.name) for name, each in grades if _by_hand(each)),
        tuple(sorted(comments)),
        found.late_submission_penalty or 0.0,
        found.total_seconds_late / DAY_S,
    )


def _points(grade: Any) -> float | None:
    """The points that count: by hand or by marking, with extra credit."""
    base: float | None = grade.auto_score if grade.manual_score is None else grade.manual_score
    extra: float | None = grade.extra_credit
    return base if extra is None else (base or 0.0) + extra


def _by_hand(grade: Any) -> bool:
    return grade.manual_score is not None or bool(grade.extra_credit)


def extend(submission: SubmittedAssignment, until: Mapping[str, datetime], ended: Collection[str]) -> None:
    """Set the extension of a submission; one that nbgrader has and we don't stays, unless it has ended."""
    student, due = submission.student.id, submission.assignment.duedate
    if due and student in until:
        submission.extension = until[student] - due
    elif student in ended:
        submission.extension = None


def penalize(
    app: NbGrader, book: Gradebook, submission: SubmittedAssignment, note: SubmittedNotebook
) -> None:
    """Set the penalty of the late submission plugin, if there is one."""
    note.late_submission_penalty = None
    book.db.flush()
    book.db.refresh(note)  # its score is a sum that the database computes
    if submission.total_seconds_late > 0:
        step = AssignLatePenalties(parent=app)
        step.init_plugin()
        penalty = step.plugin_inst.late_submission_penalty(
            submission.student.id, note.score, submission.total_seconds_late
        )
        if penalty is not None:
            note.late_submission_penalty = step._check_late_penalty(note, penalty)
    book.db.flush()
