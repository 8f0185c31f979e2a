"""The state of one submission while it is marked, which the judge's steps share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from nbformat import NotebookNode

from grader.exercise import Exercise
from grader.marking.judge.cell_outputs import DisplayRegistry
from grader.marking.judge.plain_tests import PlainTest
from grader.marking.judge.student_session import StudentSession
from grader.marking.result import CellResult
from grader.marking.submission.rebuild import RebuiltSubmission
from grader.marking.task import MarkingTask

StartSession = Callable[[], StudentSession]  # with a new process, for one notebook


@dataclass
class MarkingState:
    """The results of the steps so far.

    secret: this student's worlds and seeds are derived from it; "" for the public ones. exercises: those of
    the test cells, by notebook and grade_id. variants: the numbers of the student's, by the exercise's name;
    only of an assignment with variants. cells: the results of test cells, by notebook. stops: why a
    notebook did not run to its end. errors: those of the course. timings: see Result.
    """

    task: MarkingTask
    secret: str
    start_session: StartSession
    rebuilt: RebuiltSubmission = field(default_factory=RebuiltSubmission)
    exercises: dict[str, dict[str, Exercise | PlainTest]] = field(default_factory=dict)
    variants: dict[str, int] = field(default_factory=dict)
    cells: dict[str, list[CellResult]] = field(default_factory=dict)
    displays: DisplayRegistry = field(default_factory=DisplayRegistry)
    flags: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    stops: list[str] = field(default_factory=list)
    timings: dict[str, float] = field(default_factory=lambda: {"judged": 0.0})

    @property
    def files(self) -> dict[str, bytes]:
        """The files beside the notebooks: the release's, and the student's packages."""
        workspace = self.task.submitted.workspace
        return dict(self.task.release.files) | ({} if isinstance(workspace, str) else dict(workspace))

    def notebook(self, name: str) -> NotebookNode:
        """The notebook that is run; the release's for one that could not be rebuilt, which is not run."""
        rebuilt = self.rebuilt.notebooks.get(name)
        return self.task.release.notebooks[name] if rebuilt is None else rebuilt.notebook


def cell_name(cell: NotebookNode) -> str:
    """Its grade_id, or ""."""
    name: str = cell.metadata.get("nbgrader", {}).get("grade_id", "")
    return name


def no_points(cell: NotebookNode, exercise: Exercise | PlainTest) -> CellResult:
    """The result of a test cell that ran no nodes."""
    return CellResult(cell_name(cell), exercise.name, 0.0, float(cell.metadata.nbgrader.points))
