"""Drives a session's robot with the keys of the live picture."""

from __future__ import annotations

from collections.abc import Callable

from sim.ros.engine.program import Process
from sim.ros.play.teleop import Teleop, teleop_settings
from sim.ros.session import Session

RELEASE_TIMEOUT = 0.5  # s of wall time; the page repeats a held key ten times a second


class KeyboardDriver:
    """Passes held keys to the session's Teleop node; starts one if there is none. clock: wall time (s)."""

    def __init__(self, session: Session, clock: Callable[[], float]) -> None:
        self._session, self._clock = session, clock
        self._last_key_at = 0.0  # wall time of the last key event
        self._has_teleop = False

    def release_if_stale(self) -> None:
        """Release the keys if no key event has come for a while: the page was closed."""
        engine = self._session.engine
        if engine and self._clock() - self._last_key_at > RELEASE_TIMEOUT:
            engine.held = (0.0, 0.0)

    def drive(self, forward: float, left: float) -> None:
        """Set the keys that are held, each in [-1, 1]."""
        engine, settings = self._session.engine, teleop_settings(self._session.recording.world)
        self._last_key_at, engine.held = self._clock(), (forward, left)
        begun = engine.switches > 0  # before that, the student's Teleop would not exist yet
        exists = self._has_teleop or any(isinstance(node, Teleop) for node in self._session.nodes)
        if (forward or left) and begun and settings and not exists:
            self._has_teleop = True
            self._session.start(Process(Teleop, parameters=settings._asdict()))
