"""The side that leads: it stands in a run for all the nodes that live in another process."""

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
from sim.ros.remote.checked import MOST_WRITTEN, Nonsense, printable, text, whole
from sim.ros.remote.ledger import Ledger
from sim.ros.remote.wire import Wire, WireClosed, WireError, WireTimeout

FAULTS = ("hang", "livelock")
MOST_DETAIL = 2_000  # characters


class Remote:
    """What `sim.run` takes in place of nodes that another process serves: see `serve`.

    It may be run again and again, also after a RemoteLost that says that the process lives; `end` lets it go.

    patience: wall seconds that it may take for one answer. total: the same for all answers of one run.
    secret: the seed of the other process's own `random` is derived from it and from the seed of the run.
    deadline: returns the time by which a run must be over, by the clock `monotonic`; it may change meanwhile.
    """

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
        self._open = False  # the other process is in a run, which nobody has ended

    def ask(self, question: str, *words: Any) -> Any:
        """Ask about the nodes themselves, with "module:function" of a function of them and of these words.

        The answer is plain data, and unchecked. Raises RemoteLost.
        """
        return self._exchange(do="ask", question=question, words=words).get("answer")

    def end(self, **message: Any) -> None:
        """Say that all is over; `serve` returns this message. Raises RemoteLost."""
        try:
            if self._open:  # it was given up here, and the other process waits
                self.wire.send(do="over")
                self.wire.receive(self.patience)
            self.wire.send(**message, do="end")
        except WireError as error:
            self._lose(error)

    def program(self, preparation: Sequence[Any]) -> Callable[[], None]:
        """What `sim.run` takes for nodes that the other process prepares first.

        preparation: "module:function" of a function that makes the node that runs from each of them, and its
        further arguments; empty for none.
        """
        program = functools.partial(self, preparation)
        program.__name__ = type(self).__name__
        return program

    def __call__(self, preparation: Sequence[Any] = ()) -> None:
        """The program that runs in place of the other process's nodes. preparation: as for `program`."""
        run = engine()
        if run.link is not None:
            raise RemoteLost("Only one other process can have nodes in a run.", lives=True)
        self._waited = 0.0
        run.limits.pace *= 10  # the other process holds its nodes to it; here it is for one that doesn't
        with outside_student_code():
            turn = _Turn(self, run, preparation)
            turn.take()
        try:
            while turn.alive:
                run.wait("the other process", ready=turn.is_due, until=turn.next)
                with outside_student_code():
                    turn.take()
        except RemoteLost:
            raise
        except BaseException:  # the run is over
            with outside_student_code():
                turn.over()
            raise
        with outside_student_code():
            turn.over()

    def chance(self, seed: int) -> int:
        """The seed of the other process's own generators in a run with this seed; it doesn't tell that."""
        digest = hmac.new(self._secret, f"chance of the nodes {seed}".encode(), hashlib.sha256).digest()
        return int.from_bytes(digest[:4], "big")

    @property
    def until(self) -> float:
        """When the time of this run is over if it takes all that is left, by the clock `monotonic`."""
        return min(monotonic() + self.total - self._waited, self._deadline())

    def _exchange(self, **message: Any) -> dict[str, Any]:
        """Send, and receive the answer. Raises RemoteLost."""
        begin = monotonic()
        try:
            self.wire.send(**message)
            answer = self.wire.receive(self.patience)
        except WireError as error:
            self._lose(error)
        self._waited += monotonic() - begin
        if self._waited > self.total:
            raise RemoteLost(f"The process with the nodes took more than {self.total:g} s for one run.")
        if "failed" in answer:
            self._open = False
            why = printable(str(answer["failed"]), MOST_DETAIL)
            raise RemoteLost(f"The nodes could not be run: {why}.", lives=True)
        return answer

    def _lose(self, error: Exception) -> NoReturn:
        if isinstance(error, WireClosed):
            reason = "The process with the nodes has ended."
        elif isinstance(error, WireTimeout):
            reason = f"The process with the nodes gave no answer for {self.patience:g} s."
        else:
            reason = f"The process with the nodes sent what is no answer: {error}."
        raise RemoteLost(reason) from None


class _Turn:
    """Taking turns with the other process, in one run."""

    def __init__(self, remote: Remote, run: Any, preparation: Sequence[Any]) -> None:
        self._remote, self._run = remote, run
        self.ledger = Ledger(run)
        self._end = round(run.recording.seconds * SECOND)
        self.next: Nanoseconds | None = None
        self.alive, self._busy = True, False
        seed = remote.chance(run.recording.seed)
        try:
            seconds = run.recording.seconds
            remote.wire.send(do="run", seconds=seconds, seed=seed, preparation=list(preparation))
        except WireError as error:
            remote._lose(error)
        remote._open = True

    def is_due(self) -> bool:
        """Whether the other process has to know something now, or is not done with this moment."""
        self.ledger.gather()
        return self._busy or bool(self.ledger.news)

    def take(self) -> None:
        """Tell the news, let the other process go on until it waits, and enter what comes from it."""
        run, ledger = self._run, self.ledger
        try:
            ledger.gather()
            answer = self._remote._exchange(do="go", now=run.now, news=ledger.take_news())
            if "news" not in answer:
                when = f"The process with the nodes broke off at {run.recorder.now:.3g} s"
                why = "something in it ended the run there, or wrote to its connections"
                raise RemoteLost(f"{when}: {why}.")
            ledger.until = self._remote.until
            ledger.enter(answer["news"])
            ledger.entered()
            claims = answer.get("claims")
            ledger.claims.believe(claims if isinstance(claims, dict) else {})
            self._go_on(answer)
        except Nonsense as nonsense:
            raise _nonsense(nonsense) from None
        except Exception as error:
            raise RemoteLost("Its nodes did what this side can't follow.", True, error) from error

    def _go_on(self, answer: dict[str, Any]) -> None:
        run = self._run
        self._busy, self.alive = answer.get("busy") is True, answer.get("alive") is True
        later = whole(answer.get("next"), "a next moment", min(run.now + 1, self._end), self._end)
        self.next = later if later > run.now else None
        run.blocked_elsewhere = text(answer.get("blocked"), "a reason", MOST_DETAIL)
        fault = answer.get("fault")
        if fault is None:
            return
        if not isinstance(fault, list) or len(fault) != 2 or fault[0] not in FAULTS:
            raise Nonsense("a fault of no known kind")
        run.stop(Ended(fault[0], run.recorder.now, text(fault[1], "a reason", MOST_DETAIL)))

    def over(self) -> None:
        """Let the other process end its programs."""
        answer = self._remote._exchange(do="over")
        self._remote._open = False
        try:
            self._run.recorder.complained(text(answer.get("stderr"), "a stderr", MOST_WRITTEN))
        except Nonsense as nonsense:
            raise _nonsense(nonsense) from None


def _nonsense(nonsense: Nonsense) -> RemoteLost:
    return RemoteLost(f"The process with the nodes sent {nonsense}.", lives=True)
