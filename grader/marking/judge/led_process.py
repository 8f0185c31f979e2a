"""A student's process as the judge sees it: led from cell to cell, and never believed."""

from __future__ import annotations

import math
import socket
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from time import monotonic
from typing import Any, Protocol

from grader.marking.errors import StudentProcessGone
from grader.marking.judge.cell_outputs import CellOutputs, Displays
from grader.marking.task import TimeLimits
from grader.programs import ProgramSource, RemotePrograms
from grader.score import Score
from grader.workspace.building import Build, Built
from grader.workspace.sources import Sources
from sim.ros.remote import Remote, RemoteLost, Wire, WireClosed, WireError, WireTimeout

MESSAGE = 6_000_000  # bytes of one message
MOST_FLAGS = 5  # of one cell
GRACE = 10.0  # s that a cell has to end after it was interrupted


class Judging(Protocol):
    """Judges nodes that are handed over to it by its name: an Exercise, or what stands in its place."""

    name: str

    def judge(self, source: ProgramSource, secret: str = "") -> Score:
        """As `Exercise.judge`."""


class DeadlineWire(Wire):
    """A wire on which nobody waits for longer than until `deadline`, by the clock `monotonic`."""

    deadline = math.inf

    def receive(self, timeout: float | None = None) -> dict[str, Any]:
        """As `Wire.receive`."""
        left = self.deadline - monotonic()
        if left <= 0:
            raise WireTimeout("the time is over")
        limits = [limit for limit in (left, timeout) if limit is not None and limit < math.inf]
        return super().receive(min(limits, default=None))


@dataclass
class TestRun:
    """What became of a test cell.

    score: None if the exercise wasn't run to its end; error: what went wrong with that on our side, if
    anything; problem: what went wrong on the student's, where the process lives. flags: what no honest cell
    does.
    """

    score: Score | None = None
    error: Exception | None = None
    problem: str = ""
    flags: list[str] = field(default_factory=list)


class LedProcess:
    """Leads the process at the other end of a socket through one notebook.

    threads: whether threads of the notebook still ran when its last cell was over, as the process says.
    ending: asked when the wire breaks; how the process ended, as a sentence, or "" where that isn't known.
    build: builds the packages that it hands over.
    """

    def __init__(
        self,
        sock: socket.socket,
        time_limits: TimeLimits,
        ending: Callable[[], str],
        build: Build,
    ) -> None:
        self._wire = DeadlineWire(sock, MESSAGE)
        self._time_limits, self._ending, self._build = time_limits, ending, build
        self._over = monotonic() + time_limits.start
        self.threads = False

    def begin(self, files: Mapping[str, bytes]) -> None:
        """Wait until it is there, and put files beside its notebook. Raises StudentProcessGone."""
        self._wire.deadline = self._over
        if self._receive("It did not start.") != {"ready": True}:
            raise StudentProcessGone("It began with something else than it should.")
        self._send(files=dict(files))
        self._listen(CellOutputs(Displays()))
        self._over = monotonic() + self._time_limits.notebook

    def run(self, source: str, outputs: CellOutputs) -> None:
        """Run a cell. Says so in the outputs when it had to be interrupted. Raises StudentProcessGone."""
        began = monotonic()
        self._limit(self._time_limits.cell + GRACE)
        self._send(run=source, seconds=self._time_limits.cell)
        while self._listen(outputs) is not None:
            pass  # nobody has asked for nodes
        self._say_if_late(began, outputs)

    def test(self, source: str, exercise: Judging, outputs: CellOutputs, secret: str) -> TestRun:
        """Run a test cell, and judge the nodes that it offers to this exercise. Raises StudentProcessGone.

        secret: what private worlds and seeds are made from; "" for the public ones.
        """
        began = monotonic()
        self._limit(self._time_limits.cell + GRACE)
        self._send(test=source, seconds=self._time_limits.cell)
        tested = TestRun()
        while (named := self._listen(outputs)) is not None:
            problem = _refusal(named, exercise, tested)
            self._send(go=not problem)
            if problem:
                tested.flags += [problem] * (problem not in tested.flags and len(tested.flags) < MOST_FLAGS)
            else:
                self._grade(exercise, tested, secret)
        if tested.score is None and tested.error is None and not tested.problem:
            self._say_if_late(began, outputs)
        return tested

    def hang_up(self) -> None:
        """Nothing is left to do: the process may end."""
        self._wire.close()

    def _grade(self, exercise: Judging, tested: TestRun, secret: str) -> None:
        self._limit(self._time_limits.test)
        remote = Remote(self._wire, secret=secret, deadline=lambda: self._wire.deadline)

        def build(sources: Sources) -> Built:
            """In time that is not the student's: another process works."""
            began = monotonic()
            try:
                return self._build(sources)
            finally:
                self._over += monotonic() - began
                self._limit(self._time_limits.test)

        try:
            try:
                tested.score = exercise.judge(RemotePrograms(remote, build), secret)
            except RemoteLost as lost:
                if not lost.lives:
                    raise
                tested.error, tested.problem = lost.mistake, lost.reason
            except Exception as error:
                tested.error = error
            remote.end()
        except RemoteLost as lost:
            if monotonic() >= self._wire.deadline:
                slow = f"Its nodes took more than {self._time_limits.test:g} s."
                raise StudentProcessGone(self._too_late(slow)) from None
            raise StudentProcessGone(self._ending() or lost.reason) from None
        self._limit(self._time_limits.cell)

    def _listen(self, outputs: CellOutputs) -> str | None:
        """Take outputs until the cell is done (None) or hands over nodes: then the exercise that it names."""
        while True:
            said = self._receive("It did not stop when it was interrupted.")
            if said.get("done") is True:
                self.threads = said.get("threads") is True
                return None
            if "grade" in said:
                return str(said["grade"])[:100]
            outputs.add(said)

    def _limit(self, seconds: float) -> None:
        self._wire.deadline = min(monotonic() + seconds, self._over)

    def _say_if_late(self, began: float, outputs: CellOutputs) -> None:
        if monotonic() - began >= self._time_limits.cell:
            outputs.say(f"This cell was interrupted: it took more than {self._time_limits.cell:g} s.")

    def _send(self, **message: Any) -> None:
        try:
            self._wire.send(**message)
        except WireError:
            raise StudentProcessGone(self._ending() or "Its process ended.") from None

    def _receive(self, too_late: str) -> dict[str, Any]:
        try:
            return self._wire.receive()
        except WireTimeout:
            raise StudentProcessGone(self._too_late(too_late)) from None
        except WireClosed:
            raise StudentProcessGone(self._ending() or "Its process ended.") from None
        except WireError:
            raise StudentProcessGone("Its process said something that makes no sense.") from None

    def _too_late(self, words: str) -> str:
        """These words, unless the time of the whole notebook is over."""
        if monotonic() < self._over:
            return words
        return f"All its cells together took more than {self._time_limits.notebook:g} s."


def _refusal(named: str, exercise: Judging, tested: TestRun) -> str:
    if tested.score is not None or tested.error is not None or tested.problem:
        return "graded more than once in one cell; the first time was judged"
    if named != exercise.name:
        return f"handed its nodes to the exercise {named!r} instead of {exercise.name!r}"
    return ""
