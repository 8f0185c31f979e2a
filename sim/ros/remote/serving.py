"""The follower: the process in which the student's nodes run, led by the other process."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from sim.evidence import Ended
from sim.nanoseconds import Nanoseconds
from sim.ros.engine.endings import blocked
from sim.ros.engine.engine import Engine
from sim.ros.engine.running_program import RunningProgram
from sim.ros.remote.follower_link import FollowerLink
from sim.ros.remote.validation import MAX_STDERR_LENGTH
from sim.ros.remote.wire import Wire, WireBroken, WireClosed, WireTimeout
from sim.ros.session import Session

MAX_ROUNDS_PER_TURN = 20  # in one turn, after which the leader checks its time limits


def serve(wire: Wire, nodes: Sequence[Any]) -> dict[str, Any]:
    """Run these nodes for the leader at the other end of the wire; returns its last message.

    nodes: what `sim.run` takes. The leader names functions to call with them as "module:function"; this
    process is the student's, so it has nothing to protect from the leader. Raises WireError.
    """
    while True:
        message = wire.receive()
        command = message.get("do")
        if command == "end":
            return message
        if command == "call":
            wire.send(answer=_function(message["function"])(nodes, *message["arguments"]))
        elif command == "run":
            _run(wire, nodes, message)
        else:
            raise WireBroken(f"unknown command {command!r}")


def _function(name: str) -> Callable[..., Any]:
    try:
        return pkgutil.resolve_name(name)
    except (ImportError, AttributeError, ValueError):
        raise WireBroken(f"unknown function {name!r}") from None


def _run(wire: Wire, nodes: Sequence[Any], command: dict[str, Any]) -> None:
    commands = Commands(wire)
    try:
        name, *arguments = command["preparation"] or [""]
        prepare = _function(name) if name else None
        programs = prepared(nodes, prepare, arguments)
        about = command["seconds"], command["seed"], command["order"]
        session = Follower(commands, programs, *about)
        session.advance()
        commands.answer(stderr=session.recording.stderr[:MAX_STDERR_LENGTH])
    except (WireClosed, WireTimeout):
        raise
    except BaseException as error:  # keep serving, whatever ended the run
        # Leave out an OSError's file name, which would describe this machine.
        text = getattr(error, "strerror", None) or error
        commands.answer(failed=f"{type(error).__name__}: {text}")


def prepared(nodes: Sequence[Any], prepare: Callable[..., Any] | None, arguments: Sequence[str]) -> list[Any]:
    """The programs to run for the nodes. prepare: returns a program, or a list of them, for each node."""
    if prepare is None:
        return list(nodes)
    made = [prepare(node, *arguments) for node in nodes]
    return [program for each in made for program in (each if isinstance(each, list) else [each])]


class Commands:
    """Receives the leader's commands during a run, and sends an answer to each."""

    def __init__(self, wire: Wire) -> None:
        self._wire, self._due = wire, False

    def next(self) -> dict[str, Any]:
        """The next command."""
        command = self._wire.receive()
        self._due = True
        return command

    def answer(self, **message: Any) -> None:
        """Answer the last command or, if that is answered already, the next one."""
        if not self._due:
            self.next()
        self._wire.send(**message)
        self._due = False


class Follower(Session):
    """A run whose simulated time is set by the leader."""

    def __init__(
        self, commands: Commands, nodes: tuple[Any, ...], seconds: float, seed: int, order: str
    ) -> None:
        super().__init__(nodes, None, seconds, seed, None, True, "grade", order=order or 0)
        self._commands = commands

    def _main_loop(self, end: Nanoseconds, watched: list[RunningProgram]) -> FollowerLoop:
        return FollowerLoop(self.engine, self._commands, end)


class FollowerLoop:
    """The main loop of a run whose leader sends the moment of each step, and what its own nodes have done."""

    due: Nanoseconds = 0

    def __init__(self, engine: Engine, commands: Commands, end: Nanoseconds) -> None:
        self._engine, self._commands, self._end = engine, commands, end
        self._link = FollowerLink(engine)
        engine.transport.connect(self._link)

    def run(self, last: Nanoseconds, enough: Callable[[], bool]) -> Ended:
        """Work like `MainLoop.run`, until the leader ends the run."""
        while (command := self._commands.next()).get("do") == "go":
            moment, events = command["now"], command["events"]
            self._engine.transport.events.schedule_arrival(moment, partial(self._link.apply, events))
            busy = self._engine.step(moment, _Pause(self._engine, self._link).is_due)
            self._link.collect()
            self._commands.answer(**self._answer(busy))
        return Ended("time", self._engine.recorder.now, "The other side has ended the run.")

    def _answer(self, busy: bool) -> dict[str, Any]:
        engine, link, fault = self._engine, self._link, self._engine.fault
        if engine.now >= self._end:
            engine.note_unfinished()
        return {
            "events": link.take_outgoing(),
            "self_reports": link.take_self_reports(),
            "next": engine.next_moment(self._end),
            "busy": busy and fault is None,
            "alive": any(not fiber.done for fiber in engine.fibers),
            "fault": None if fault is None else [fault.reason, fault.detail],
            "blocked": (blocked(engine) or "") if engine.now >= self._end else "",
        }


class _Pause:
    """When a step of the follower ends early: it has events for the leader, or has taken long."""

    def __init__(self, engine: Engine, link: FollowerLink) -> None:
        self._engine, self._link, self._rounds = engine, link, 0

    def is_due(self) -> bool:
        self._engine.limits.check_pace()
        self._link.collect()
        self._rounds += 1
        # In another order than the usual one, both processes take turns round by round, as one process does.
        another = self._engine.choices is not None
        return another or bool(self._link.outgoing) or self._rounds >= MAX_ROUNDS_PER_TURN
