"""One submission while it is marked: what the judge's steps share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from nbformat import NotebookNode

from grader.exercise import Exercise
from grader.marking.judge.cell_outputs import Displays
from grader.marking.judge.led_process import LedProcess
from grader.marking.result import CellResult
from grader.marking.submission.rebuild import RebuiltSubmission
from grader.marking.task import Task

StartStudentProcess = Callable[[], LedProcess]  # gives a fresh process, for one notebook


@dataclass
class Marking:
    """What the steps have made of a task so far.

    secret: where this student's worlds and seeds come from; "" for the public ones. exercises: what test
    cells grade, by notebook and grade_id. cells: what these earned, by notebook. stops: why a notebook did
    not come to its end. timings: see Result.
    """

    task: Task
    secret: str
    start_process: StartStudentProcess
    rebuilt: RebuiltSubmission = field(default_factory=RebuiltSubmission)
    exercises: dict[str, dict[str, Exercise]] = field(default_factory=dict)
    cells: dict[str, list[CellResult]] = field(default_factory=dict)
    displays: Displays = field(default_factory=Displays)
    flags: list[str] = field(default_factory=list)
    stops: list[str] = field(default_factory=list)
    timings: dict[str, float] = field(default_factory=lambda: {"judged": 0.0})

    @property
    def files(self) -> dict[str, bytes]:
        """What lies beside the notebooks: the release's files, and the student's packages."""
        workspace = self.task.submitted.workspace
        return dict(self.task.release.files) | ({} if isinstance(workspace, str) else dict(workspace))

    def notebook(self, name: str) -> NotebookNode:
        """What is run; of one that could not be rebuilt, the release's, which is not."""
        rebuilt = self.rebuilt.notebooks.get(name)
        return self.task.release.notebooks[name] if rebuilt is None else rebuilt.notebook


def cell_name(cell: NotebookNode) -> str:
    """Its grade_id, or ""."""
    return cell.metadata.get("nbgrader", {}).get("grade_id", "")


def no_points(cell: NotebookNode, exercise: Exercise) -> CellResult:
    """The result of a test cell that ran no nodes."""
    return CellResult(cell_name(cell), exercise.name, 0.0, float(cell.metadata.nbgrader.points))
