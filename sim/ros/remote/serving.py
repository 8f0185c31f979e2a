"""The follower: the process in which the student's nodes run, led by the other process."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Generator, Sequence
from typing import Any

from sim.evidence import Ended
from sim.nanoseconds import Nanoseconds
from sim.ros.engine.endings import blocked
from sim.ros.engine.processes import StudentProcess
from sim.ros.fibers.exceptions import Livelock
from sim.ros.remote.follower_link import FollowerLink
from sim.ros.remote.validation import MAX_STDERR_LENGTH
from sim.ros.remote.wire import Wire, WireBroken, WireClosed, WireTimeout
from sim.ros.session import FOREVER, Session

MAX_ROUNDS_PER_TURN = 20  # in one turn, after which the leader checks its time limits


def serve(wire: Wire, nodes: Sequence[Any]) -> dict[str, Any]:
    """Run these nodes for the leader at the other end of the wire; returns its last message.

    nodes: what `sim.run` takes. The leader names functions to call with them as "module:function"; this
    process is the student's, so it has nothing to protect from the leader. Raises WireError.
    """
    while True:
        message = wire.receive()
        wanted = message.get("do")
        if wanted == "end":
            return message
        if wanted == "ask":
            wire.send(answer=_function(message["question"])(nodes, *message["words"]))
        elif wanted == "run":
            _run(wire, nodes, message)
        else:
            raise WireBroken(f"nobody here knows how to {wanted}")


def _function(name: str) -> Callable[..., Any]:
    try:
        return pkgutil.resolve_name(name)
    except (ImportError, AttributeError, ValueError):
        raise WireBroken(f"nobody here knows the function {name}") from None


def _run(wire: Wire, nodes: Sequence[Any], order: dict[str, Any]) -> None:
    orders = Orders(wire)
    try:
        name, *words = order["preparation"] or [""]
        prepare = _function(name) if name else None
        programs = prepared(nodes, prepare, words)
        session = Follower(orders, programs, order["seconds"], order["seed"])
        session.advance()
        orders.answer(stderr=session.recording.stderr[:MAX_STDERR_LENGTH])
    except (WireClosed, WireTimeout):
        raise
    except BaseException as error:  # keep serving, whatever ended the run
        # Leave out an OSError's file name, which would describe this machine.
        words = getattr(error, "strerror", None) or error
        orders.answer(failed=f"{type(error).__name__}: {words}")


def prepared(nodes: Sequence[Any], prepare: Callable[..., Any] | None, words: Sequence[str]) -> list[Any]:
    """The programs to run for the nodes. prepare: returns a program, or a list of them, for each node."""
    if prepare is None:
        return list(nodes)
    made = [prepare(node, *words) for node in nodes]
    return [program for each in made for program in (each if isinstance(each, list) else [each])]


class Orders:
    """Receives the leader's orders during a run, and sends an answer to each."""

    def __init__(self, wire: Wire) -> None:
        self._wire, self._due = wire, False

    def next(self) -> dict[str, Any]:
        """The next order."""
        order = self._wire.receive()
        self._due = True
        return order

    def answer(self, **message: Any) -> None:
        """Answer the last order or, if that is answered already, the next one."""
        if not self._due:
            self.next()
        self._wire.send(**message)
        self._due = False


class Follower(Session):
    """A run whose simulated time is set by the leader."""

    def __init__(self, orders: Orders, nodes: tuple[Any, ...], seconds: float, seed: int) -> None:
        super().__init__(nodes, None, seconds, seed, None, True, "grade")
        self._orders = orders

    def _course(self, end: Nanoseconds, watched: list[StudentProcess]) -> Generator[Nanoseconds, None, Ended]:
        link = FollowerLink(self.engine)
        while (order := self._orders.next()).get("do") == "go":
            self._move_to(order["now"])
            link.apply(order["events"])
            busy = self._rounds(link)
            self._orders.answer(**self._answer(link, busy, end))
            yield order["now"]
        return Ended("time", self.engine.recorder.now, "The other side has ended the run.")

    def _move_to(self, now: Nanoseconds) -> None:
        engine = self.engine
        if now > engine.now:
            engine.time.move_to(now)
            engine.begin_moment()

    def _rounds(self, link: FollowerLink) -> bool:
        """Run the nodes until they wait or have events for the leader; returns whether they could go on."""
        engine, busy = self.engine, True
        try:
            for _ in range(MAX_ROUNDS_PER_TURN):
                engine.limits.check_pace()
                engine.round()
                link.collect()
                left = [fiber for fiber in engine.fibers if not fiber.done]
                waits = any(fiber.runnable() for fiber in left) or engine.agenda.next(FOREVER) <= engine.now
                busy = engine.fault is None and waits
                if link.outgoing or not busy:
                    break
        except Livelock:  # the engine has stored the reason
            link.collect()
            return False
        return busy

    def _answer(self, link: FollowerLink, busy: bool, end: Nanoseconds) -> dict[str, Any]:
        engine = self.engine
        fault, planned = engine.fault, engine.agenda.next(end)
        return {
            "events": link.take_outgoing(),
            "self_reports": link.take_self_reports(),
            "next": engine.time.next_moment(end if planned <= engine.now else planned),
            "busy": busy,
            "alive": any(not fiber.done for fiber in engine.fibers),
            "fault": None if fault is None else [fault.reason, fault.detail],
            "blocked": (blocked(engine) or "") if engine.now >= end else "",
        }
