"""Students' processes for tests: without a cage, since what is tested here is what runs in it."""
import socket
from collections.abc import Callable, Iterator

import pytest

from grader.marking.court.outputs import Outputs, Screen
from grader.marking.court.pupil import Pupil
from grader.marking.orders import Patience
from grader.marking.pool import WARM
from grader.marking.sandbox import Inmate, Sandbox

QUICK = Patience(cell=1.0, notebook=60.0)


class Seat:
    """A student's process and what its cells have shown."""

    def __init__(self, sandbox: Sandbox, patience: Patience, files: dict[str, bytes] | None) -> None:
        ours, theirs = socket.socketpair()
        self.inmate: Inmate = sandbox.start(theirs)
        self.pupil = Pupil(ours, patience, lambda: self.inmate.wait(10).detail)
        self.screen = Screen()
        self.outputs = Outputs(self.screen)
        if files is not None:
            self.pupil.begin(files)

    def run(self, source: str) -> list[dict]:
        """What a cell shows."""
        self.outputs = Outputs(self.screen)
        self.pupil.run(source, self.outputs)
        return self.outputs.list

    def text(self, source: str) -> str:
        """What a cell writes."""
        return "".join(output["text"] for output in self.run(source) if output["output_type"] == "stream")

    def leave(self) -> None:
        self.inmate.kill()
        self.inmate.wait(10)


@pytest.fixture(scope="session")
def school() -> Iterator[Sandbox]:
    with Sandbox(preload=WARM, unsafe=True) as sandbox:
        yield sandbox


@pytest.fixture
def seats(school) -> Iterator[Callable[..., Seat]]:
    """Makes students' processes, and sees to it that none is left."""
    made: list[Seat] = []

    def make(patience: Patience = QUICK, begun: bool = True, **files: bytes) -> Seat:
        made.append(Seat(school, patience, files if begun else None))
        return made[-1]

    yield make
    for seat in made:
        seat.leave()


@pytest.fixture
def seat(seats) -> Seat:
    return seats()
