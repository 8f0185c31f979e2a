"""The leader's program for the nodes that run in another process."""

from __future__ import annotations

import functools
import hashlib
import hmac
import math
from collections.abc import Callable, Sequence
from time import monotonic
from typing import Any, NoReturn

from sim.evidence import Ended
from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.fibers.exceptions import RemoteLost
from sim.ros.fibers.scheduler import engine, outside_student_code
from sim.ros.remote.leader_link import LeaderLink
from sim.ros.remote.validation import MAX_STDERR_LENGTH, ProtocolError, printable, valid_int, valid_text
from sim.ros.remote.wire import Wire, WireClosed, WireError, WireTimeout

FAULTS = ("hang", "livelock")
MAX_DETAIL_LENGTH = 2_000  # characters
PREPARING = 4  # times the patience: to prepare may be to run a student's test, which has runs of its own


class Remote:
    """A program for `sim.run` that represents the nodes which another process runs with `serve`.

    It can be run several times, also after a RemoteLost whose process is still alive. `end` releases it.

    patience: wall seconds until a single answer must arrive; four times as many for the first one of nodes
    that are prepared. total: wall seconds for all answers of one run.
    secret: key from which the seed of the other process's `random` is derived, together with the run's seed.
    deadline: returns the time by which a run must be over, by the clock `monotonic`; it may change meanwhile.
    """

    runs_elsewhere = True  # so the other process decides when its programs start, in another order

    def __init__(
        self,
        wire: Wire,
        patience: float = 30.0,
        total: float = 300.0,
        secret: str = "",
        deadline: Callable[[], float] | None = None,
    ) -> None:
        self.wire, self.patience, self.total = wire, patience, total
        self._secret, self._deadline = secret.encode(), deadline or (lambda: math.inf)
        self._waited = 0.0
        self._open = False  # the other process is in a run that was not ended

    def call(self, function: str, *arguments: Any) -> Any:
        """Call a function of the nodes and these arguments in the other process, given as "module:function".

        The result is plain data and is not validated. Raises RemoteLost.
        """
        return self._exchange(do="call", function=function, arguments=arguments).get("answer")

    def end(self, **message: Any) -> None:
        """Release the other process: its `serve` returns this message. Raises RemoteLost."""
        try:
            if self._open:  # the run was aborted here, and the other process still waits
                self.wire.send(do="over")
                self.wire.receive(self.patience)
            self.wire.send(**message, do="end")
        except WireError as error:
            self._lose(error)

    def program(self, preparation: Sequence[Any]) -> Callable[[], None]:
        """A program for `sim.run` whose nodes the other process prepares first.

        preparation: "module:function" of a function that returns the node to run for each of the nodes, and
        its further arguments; empty for none.
        """
        program = functools.partial(self, preparation)
        program.__name__ = type(self).__name__  # type: ignore[attr-defined]
        program.runs_elsewhere = True  # type: ignore[attr-defined]
        return program

    def __call__(self, preparation: Sequence[Any] = ()) -> None:
        """Run the other process's nodes as a program of the current run. Raises RemoteLost.

        preparation: as for `program`.
        """
        run = engine()
        if run.transport.peer is not None:
            raise RemoteLost("Only one other process can have nodes in a run.", lives=True)
        self._waited = 0.0
        run.limits.relax_pace(10)  # the other process enforces it; here it stops only a process that doesn't
        with outside_student_code():
            exchange = _RunExchange(self, run, preparation)
            exchange.take_turn()
        try:
            while exchange.alive:
                run.wait("the other process", ready=exchange.is_due, until=exchange.next)
                with outside_student_code():
                    exchange.take_turn()
        except RemoteLost:
            raise
        except BaseException:  # the run is over
            with outside_student_code():
                exchange.finish()
            raise
        with outside_student_code():
            exchange.finish()

    def derived_seed(self, seed: int) -> int:
        """The seed of the other process's random generators; it does not reveal the run's seed."""
        digest = hmac.new(self._secret, f"chance of the nodes {seed}".encode(), hashlib.sha256).digest()
        return int.from_bytes(digest[:4], "big")

    @property
    def until(self) -> float:
        """The latest end of this run, by the clock `monotonic`."""
        return min(monotonic() + self.total - self._waited, self._deadline())

    def _exchange(self, patience: float = 0.0, **message: Any) -> dict[str, Any]:
        """Send a message and receive the answer. patience: 0 for the usual one. Raises RemoteLost."""
        begin = monotonic()
        patience = patience or self.patience
        try:
            self.wire.send(**message)
            answer = self.wire.receive(patience)
        except WireError as error:
            self._lose(error, patience)
        self._waited += monotonic() - begin
        if self._waited > self.total:
            raise RemoteLost(f"The process with the nodes took more than {self.total:g} s for one run.")
        if "failed" in answer:
            self._open = False
            why = printable(str(answer["failed"]), MAX_DETAIL_LENGTH)
            raise RemoteLost(f"The nodes could not be run: {why}.", lives=True)
        return answer

    def _lose(self, error: Exception, patience: float = 0.0) -> NoReturn:
        if isinstance(error, WireClosed):
            reason = "The process with the nodes has ended."
        elif isinstance(error, WireTimeout):
            reason = f"The process with the nodes gave no answer for {patience or self.patience:g} s."
        else:
            reason = f"The process with the nodes sent an invalid answer: {error}."
        raise RemoteLost(reason) from None


class _RunExchange:
    """Takes turns with the other process during one run."""

    def __init__(self, remote: Remote, run: Any, preparation: Sequence[Any]) -> None:
        self._remote, self._run = remote, run
        self.link = LeaderLink(run)
        run.transport.connect(self.link)
        self._end = round(run.recording.seconds * SECOND)
        self.next: Nanoseconds | None = None
        self.alive, self._busy = True, False
        self._patience = remote.patience * (PREPARING if preparation else 1)  # for the first answer
        seed = remote.derived_seed(run.recording.seed)
        try:
            about = {"seconds": run.recording.seconds, "seed": seed, "order": run.recording.order}
            remote.wire.send(do="run", preparation=list(preparation), **about)
        except WireError as error:
            remote._lose(error)
        remote._open = True

    def is_due(self) -> bool:
        """Return whether there are events for the other process, or it has more to do at this time step."""
        self.link.collect()
        return self._busy or bool(self.link.outgoing)

    def take_turn(self) -> None:
        """Send the events, let the other process run until it waits, and apply its events."""
        run, link = self._run, self.link
        try:
            link.collect()
            events = link.take_outgoing()
            answer = self._remote._exchange(self._patience, do="go", now=run.now, events=events)
            self._patience = self._remote.patience
            if "events" not in answer:
                when = f"The process with the nodes ended unexpectedly at {run.recorder.now:.3g} s"
                why = "something in it ended the run there, or wrote to its connections"
                raise RemoteLost(f"{when}: {why}.")
            link.deadline = self._remote.until
            link.apply(answer["events"])
            link.discard_applied()
            reports = answer.get("self_reports")
            link.self_reports.record(reports if isinstance(reports, dict) else {})
            self._update(answer)
        except ProtocolError as error:
            raise _remote_lost(error) from None
        except Exception as error:
            raise RemoteLost(
                "Its nodes did something that the leading process can't reproduce.", True, error
            ) from error

    def _update(self, answer: dict[str, Any]) -> None:
        run = self._run
        self._busy, self.alive = answer.get("busy") is True, answer.get("alive") is True
        later = valid_int(answer.get("next"), "a next moment", min(run.now + 1, self._end), self._end)
        self.next = later if later > run.now else None
        self.link.blocked = valid_text(answer.get("blocked"), "a reason", MAX_DETAIL_LENGTH)
        fault = answer.get("fault")
        if fault is None:
            return
        if not isinstance(fault, list) or len(fault) != 2 or fault[0] not in FAULTS:
            raise ProtocolError("a fault of unknown kind")
        run.stop(Ended(fault[0], run.recorder.now, valid_text(fault[1], "a reason", MAX_DETAIL_LENGTH)))

    def finish(self) -> None:
        """Let the other process end its programs and hand over its stderr."""
        answer = self._remote._exchange(do="over")
        self._remote._open = False
        try:
            self._run.recorder.add_stderr(valid_text(answer.get("stderr"), "a stderr", MAX_STDERR_LENGTH))
        except ProtocolError as error:
            raise _remote_lost(error) from None


def _remote_lost(error: ProtocolError) -> RemoteLost:
    return RemoteLost(f"The process with the nodes sent {error}.", lives=True)
