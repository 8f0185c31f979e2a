"""The judge's session with a student's process: it requests cell after cell, and trusts no answer."""

from __future__ import annotations

import math
import socket
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from time import monotonic
from typing import Any, Protocol

from grader.marking.errors import StudentProcessGone
from grader.marking.judge.cell_outputs import CellOutputs, DisplayRegistry
from grader.marking.task import TimeLimits
from grader.programs import ProgramSource, RemotePrograms
from grader.score import Score
from grader.workspace.building import Build, Built
from grader.workspace.sources import Sources
from sim.ros.remote import Remote, RemoteLost, Wire, WireClosed, WireError, WireTimeout

MESSAGE = 6_000_000  # bytes of one message
MAX_FLAGS = 5  # of one cell
RESOURCES = ("memory", "threads", "open files", "disk space")  # that a process may use up
GRACE = 10.0  # s in which a cell must end after it was interrupted


class NodeJudge(Protocol):
    """Judges nodes that are handed over to it by name: an Exercise, or a replacement for one."""

    name: str

    def judge(self, source: ProgramSource, secret: str = "") -> Score:
        """Work like `Exercise.judge`."""


class DeadlineWire(Wire):
    """A wire that waits for no message after `deadline`, by the clock `monotonic`."""

    deadline = math.inf

    def receive(self, timeout: float | None = None) -> dict[str, Any]:
        """Work like `Wire.receive`."""
        left = self.deadline - monotonic()
        if left <= 0:
            raise WireTimeout("the time is up")
        limits = [limit for limit in (left, timeout) if limit is not None and limit < math.inf]
        return super().receive(min(limits, default=None))


@dataclass
class TestRun:
    """The outcome of a test cell.

    score: None if the exercise wasn't run to its end; error: the course's error that prevented it, if any;
    problem: the student's, if the process still runs. flags: sentences on what no honest cell does.
    """

    score: Score | None = None
    error: Exception | None = None
    problem: str = ""
    flags: list[str] = field(default_factory=list)


class StudentSession:
    """Runs one notebook in the process at the other end of a socket.

    threads_left: whether threads of the notebook still ran after its last cell, as the process claims.
    used_up: what it has used up after this cell, such as "memory", as it claims; "" for nothing.
    over: when the time of the whole notebook is over, by the clock `monotonic`.
    describe_end: called when the wire breaks; returns how the process ended, as a sentence, or "" if unknown.
    build: builds the packages that it hands over.
    """

    def __init__(
        self, sock: socket.socket, time_limits: TimeLimits, describe_end: Callable[[], str], build: Build
    ) -> None:
        self._wire = DeadlineWire(sock, MESSAGE)
        self._time_limits, self._describe_end, self._build = time_limits, describe_end, build
        self.over = monotonic() + time_limits.start
        self.threads_left, self.used_up = False, ""

    def begin(
        self, files: Mapping[str, bytes], packages: Sequence[str] = (), over: float | None = None
    ) -> None:
        """Wait until the process is ready, and write files beside its notebook. Raises StudentProcessGone.

        packages: those of exercises that it can import. over: of a process before it.
        """
        self._wire.deadline = min(self.over, over or math.inf)
        if self._receive("It did not start.") != {"ready": True}:
            raise StudentProcessGone("It did not begin as expected.")
        self._send(files=dict(files), packages=list(packages))
        self._listen(CellOutputs(DisplayRegistry()))
        self.over = over or monotonic() + self._time_limits.notebook

    def run(self, source: str, outputs: CellOutputs) -> None:
        """Run a cell; its outputs say if it had to be interrupted. Raises StudentProcessGone."""
        began = monotonic()
        self._limit(self._time_limits.cell + GRACE)
        self._send(run=source, seconds=self._time_limits.cell)
        while self._listen(outputs) is not None:
            pass  # the judge requested no nodes
        self._note_if_late(began, outputs)

    def test(self, source: str, exercise: NodeJudge, outputs: CellOutputs, secret: str) -> TestRun:
        """Run a test cell, and judge the nodes that it hands to this exercise. Raises StudentProcessGone.

        secret: private worlds and seeds are derived from it; "" for the public ones.
        """
        began = monotonic()
        self._limit(self._time_limits.cell + GRACE)
        self._send(test=source, seconds=self._time_limits.cell)
        tested = TestRun()
        while (named := self._listen(outputs)) is not None:
            problem = _refusal(named, exercise, tested)
            self._send(go=not problem)
            if problem:
                tested.flags += [problem] * (problem not in tested.flags and len(tested.flags) < MAX_FLAGS)
            else:
                self._grade(exercise, tested, secret)
        if tested.score is None and tested.error is None and not tested.problem:
            self._note_if_late(began, outputs)
        return tested

    def close(self) -> None:
        """Close the connection, so that the process ends."""
        self._wire.close()

    def _grade(self, exercise: NodeJudge, tested: TestRun, secret: str) -> None:
        self._limit(self._time_limits.test)
        remote = Remote(self._wire, secret=secret, deadline=lambda: self._wire.deadline)

        def build(sources: Sources) -> Built:
            """Build in another process; the student's time limits are extended meanwhile."""
            began = monotonic()
            try:
                return self._build(sources)
            finally:
                self.over += monotonic() - began
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
            raise StudentProcessGone(self._describe_end() or lost.reason) from None
        self._limit(self._time_limits.cell)

    def _listen(self, outputs: CellOutputs) -> str | None:
        """Receive outputs until the cell is done (None) or hands over nodes (its exercise's name)."""
        while True:
            message = self._receive("It did not stop when it was interrupted.")
            if message.get("done") is True:
                self.threads_left = message.get("threads") is True
                self.used_up = message["used_up"] if message.get("used_up") in RESOURCES else ""
                return None
            if "grade" in message:
                return str(message["grade"])[:100]
            outputs.add(message)

    def _limit(self, seconds: float) -> None:
        self._wire.deadline = min(monotonic() + seconds, self.over)

    def _note_if_late(self, began: float, outputs: CellOutputs) -> None:
        if monotonic() - began >= self._time_limits.cell:
            outputs.add_line(f"This cell was interrupted: it took more than {self._time_limits.cell:g} s.")

    def _send(self, **message: Any) -> None:
        try:
            self._wire.send(**message)
        except WireError:
            raise StudentProcessGone(self._describe_end() or "Its process ended.") from None

    def _receive(self, too_late: str) -> dict[str, Any]:
        try:
            return self._wire.receive()
        except WireTimeout:
            raise StudentProcessGone(self._too_late(too_late)) from None
        except WireClosed:
            raise StudentProcessGone(self._describe_end() or "Its process ended.") from None
        except WireError:
            raise StudentProcessGone("Its process sent an invalid message.") from None

    def _too_late(self, reason: str) -> str:
        """The reason, unless the time of the whole notebook is over."""
        if monotonic() < self.over:
            return reason
        return f"All its cells together took more than {self._time_limits.notebook:g} s."


def _refusal(named: str, exercise: NodeJudge, tested: TestRun) -> str:
    if tested.score is not None or tested.error is not None or tested.problem:
        return "graded more than once in one cell; only the first time counts"
    if named != exercise.name:
        return f"passed its nodes to the exercise {named!r} instead of {exercise.name!r}"
    return ""
