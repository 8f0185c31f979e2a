"""The user's hand on the keys of the picture."""

from __future__ import annotations

from collections.abc import Callable

from sim.ros.engine.program import Process
from sim.ros.play.teleop import Teleop, reins
from sim.ros.session import Session

LET_GO = 0.5  # s of wall time; who holds a key says so ten times a second


class Hand:
    """Drives the robot of a session, with a Teleop of its own where no node is one. clock: of the wall."""

    def __init__(self, session: Session, clock: Callable[[], float]) -> None:
        self._session, self._clock = session, clock
        self._held_at = 0.0  # wall time of the last key that was held or let go
        self._drives = False

    def rest(self) -> None:
        """Let go where nobody has held a key for a while: the page is gone."""
        engine = self._session.engine
        if engine and self._clock() - self._held_at > LET_GO:
            engine.held = (0.0, 0.0)

    def drive(self, forward: float, left: float) -> None:
        """Hold these keys, each in [-1, 1]."""
        engine, held = self._session.engine, reins(self._session.recording.world)
        self._held_at, engine.held = self._clock(), (forward, left)
        begun = engine.switches > 0  # before, nobody's Teleop is there yet
        there = self._drives or any(isinstance(node, Teleop) for node in self._session.nodes)
        if (forward or left) and begun and held and not there:
            self._drives = True
            self._session.start(Process(Teleop, parameters=held._asdict()))
