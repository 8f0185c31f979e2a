"""Students' processes for tests: without a sandbox, since what is tested here is what runs in it."""
import socket
from collections.abc import Callable, Iterator

import pytest

from grader.marking.judge.cell_outputs import CellOutputs, DisplayRegistry
from grader.marking.judge.student_session import StudentSession
from grader.marking.pool import PRELOAD
from grader.marking.sandbox import ConfinedProcess, Sandbox
from grader.marking.task import TimeLimits
from grader.workspace.building import build

USUAL = TimeLimits()
QUICK = TimeLimits(cell=1.0)  # for cells without end: on a busy machine, others take longer, too
PATIENCE = 60.0  # s of wall time


class StartedStudent:
    """A student's process and what its cells have shown."""

    def __init__(self, sandbox: Sandbox, time_limits: TimeLimits, files: dict[str, bytes] | None) -> None:
        ours, theirs = socket.socketpair()
        self.process: ConfinedProcess = sandbox.start(theirs)
        self.student = StudentSession(ours, time_limits, lambda: self.process.wait(PATIENCE).detail, build)
        self.displays = DisplayRegistry()
        self.outputs = CellOutputs(self.displays)
        if files is not None:
            self.student.begin(files)

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
def start_student(plain_sandbox) -> Iterator[Callable[..., StartedStudent]]:
    """Makes students' processes, and sees to it that none is left."""
    made: list[StartedStudent] = []

    def make(time_limits: TimeLimits = USUAL, begun: bool = True, **files: bytes) -> StartedStudent:
        made.append(StartedStudent(plain_sandbox, time_limits, files if begun else None))
        return made[-1]

    yield make
    for student in made:
        student.leave()


@pytest.fixture
def student(start_student) -> StartedStudent:
    return start_student()
