"""Students' processes for tests: without a sandbox, since what is tested here is what runs in it."""
import socket
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import pytest

from grader.marking.judge.cell_outputs import CellOutputs, DisplayRegistry
from grader.marking.judge.student_session import StudentSession, TestRun
from grader.marking.pool import PRELOAD
from grader.marking.sandbox import ConfinedProcess, Sandbox
from grader.marking.task import TimeLimits
from grader.workspace.building import build
from tests.patience import PATIENCE

USUAL = TimeLimits(start=PATIENCE, cell=PATIENCE, test=PATIENCE, notebook=10 * PATIENCE)
QUICK = TimeLimits(cell=0.5, test=0.5)


class QuickSession(StudentSession):
    """Has the quick limits in each cell with the text `quick`; in others, all the time that they need."""

    def __init__(self, quick: str, sock: socket.socket, ending: Callable[[], str]) -> None:
        super().__init__(sock, USUAL, ending, build)
        self._quick = quick

    def run(self, source: str, *more: Any) -> None:
        self._time_limits = QUICK if self._quick in source else USUAL
        super().run(source, *more)

    def test(self, source: str, *more: Any) -> TestRun:
        self._time_limits = QUICK if self._quick in source else USUAL
        return super().test(source, *more)


class StartedStudent:
    """A student's process and what its cells have shown. quick: as for QuickSession."""

    def __init__(self, sandbox: Sandbox, quick: str, files: dict[str, bytes] | None,
                 packages: Sequence[str]) -> None:
        parent_end, child_end = socket.socketpair()
        self.process: ConfinedProcess = sandbox.start(child_end)
        self.student = QuickSession(quick, parent_end, lambda: self.process.wait(PATIENCE).detail)
        self.displays = DisplayRegistry()
        self.outputs = CellOutputs(self.displays)
        if files is not None:
            self.student.begin(files, packages)

    def run(self, source: str) -> list[dict]:
        """What a cell shows."""
        self.outputs = CellOutputs(self.displays)
        self.student.run(source, self.outputs)
        return self.outputs.list

    def text(self, source: str) -> str:
        """What a cell writes."""
        return "".join(output["text"] for output in self.run(source) if output["output_type"] == "stream")

    def leave(self) -> None:
        self.process.kill()
        self.process.wait(PATIENCE)


@pytest.fixture(scope="session")
def plain_sandbox() -> Iterator[Sandbox]:
    with Sandbox(preload=PRELOAD, unsafe=True) as sandbox:
        yield sandbox


@pytest.fixture
def start_student(plain_sandbox, monkeypatch) -> Iterator[Callable[..., StartedStudent]]:
    """Makes students' processes, and sees to it that none is left."""
    made: list[StartedStudent] = []
    monkeypatch.setattr("grader.marking.judge.student_session.GRACE", PATIENCE)

    def make(quick: str = "no cell has this", begun: bool = True, packages: Sequence[str] = (),
             **files: bytes) -> StartedStudent:
        made.append(StartedStudent(plain_sandbox, quick, files if begun else None, packages))
        return made[-1]

    yield make
    for student in made:
        student.leave()


@pytest.fixture
def student(start_student) -> StartedStudent:
    return start_student()
