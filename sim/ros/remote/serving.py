"""The process in which the student's nodes live. It follows: the other side leads."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Generator, Sequence
from typing import Any

from sim.evidence import Ended
from sim.nanoseconds import Nanoseconds
from sim.ros.engine.endings import blocked
from sim.ros.engine.processes import StudentProcess
from sim.ros.fibers.exceptions import Livelock
from sim.ros.remote.checked import MOST_WRITTEN
from sim.ros.remote.reports import Reports
from sim.ros.remote.wire import Wire, WireBroken, WireClosed, WireTimeout
from sim.ros.session import FOREVER, Session

MOST_ROUNDS = 20  # in one turn: the other side waits for its end, and looks after time


def serve(wire: Wire, nodes: Sequence[Any]) -> dict[str, Any]:
    """Let the other end of the wire run these nodes, as often as it likes; returns its last message.

    nodes: what `sim.run` takes. Questions about them, and what is to be run in place of each, are functions
    named as "module:function": this side belongs to the nodes, and hides nothing from the other. Raises
    WireError when the wire breaks.
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
        orders.answer(stderr=session.recording.stderr[:MOST_WRITTEN])
    except (WireClosed, WireTimeout):
        raise
    except BaseException as error:  # this side goes on to serve, whatever ended the run here
        # Of the system's errors without the file: its name tells of this machine.
        words = getattr(error, "strerror", None) or error
        orders.answer(failed=f"{type(error).__name__}: {words}")


def prepared(nodes: Sequence[Any], prepare: Callable[..., Any] | None, words: Sequence[str]) -> list[Any]:
    """What runs in place of the nodes. prepare: makes of each the one that runs, or a list of those."""
    if prepare is None:
        return list(nodes)
    made = [prepare(node, *words) for node in nodes]
    return [program for each in made for program in (each if isinstance(each, list) else [each])]


class Orders:
    """What the other side orders in a run, one thing after the other, and an answer to each."""

    def __init__(self, wire: Wire) -> None:
        self._wire, self._due = wire, False

    def next(self) -> dict[str, Any]:
        """The next one."""
        order = self._wire.receive()
        self._due = True
        return order

    def answer(self, **message: Any) -> None:
        """The answer to the last one; to the next, if that has its answer already."""
        if not self._due:
            self.next()
        self._wire.send(**message)
        self._due = False


class Follower(Session):
    """A run whose time is that of the other side."""

    def __init__(self, orders: Orders, nodes: tuple[Any, ...], seconds: float, seed: int) -> None:
        super().__init__(nodes, None, seconds, seed, None, True, "grade")
        self._orders = orders

    def _course(self, end: Nanoseconds, watched: list[StudentProcess]) -> Generator[Nanoseconds, None, Ended]:
        link = Reports(self.engine)
        while (order := self._orders.next()).get("do") == "go":
            self._move_to(order["now"])
            link.enter(order["news"])
            busy = self._rounds(link)
            self._orders.answer(**self._answer(link, busy, end))
            yield order["now"]
        return Ended("time", self.engine.recorder.now, "The other side has ended the run.")

    def _move_to(self, now: Nanoseconds) -> None:
        engine = self.engine
        if now > engine.now:
            engine.time.move_to(now)
            engine.begin_moment()

    def _rounds(self, link: Reports) -> bool:
        """Let the nodes go on until they wait or have news for the other side; whether they could go on."""
        engine, busy = self.engine, True
        try:
            for _ in range(MOST_ROUNDS):
                engine.limits.check_pace()
                engine.round()
                link.gather()
                left = [fiber for fiber in engine.fibers if not fiber.done]
                waits = any(fiber.runnable() for fiber in left) or engine.agenda.next(FOREVER) <= engine.now
                busy = engine.fault is None and waits
                if link.news or not busy:
                    break
        except Livelock:  # its reason is kept
            link.gather()
            return False
        return busy

    def _answer(self, link: Reports, busy: bool, end: Nanoseconds) -> dict[str, Any]:
        engine = self.engine
        fault, planned = engine.fault, engine.agenda.next(end)
        return {
            "news": link.take_news(),
            "claims": link.claims(),
            "next": engine.time.next_moment(end if planned <= engine.now else planned),
            "busy": busy,
            "alive": any(not fiber.done for fiber in engine.fibers),
            "fault": None if fault is None else [fault.reason, fault.detail],
            "blocked": (blocked(engine) or "") if engine.now >= end else "",
        }
