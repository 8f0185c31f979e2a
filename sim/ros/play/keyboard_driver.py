"""Passes the keys and clicks of the live picture to a session's nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sim.ros.engine.program import Process
from sim.ros.play.pointer import Pointer
from sim.ros.play.teleop import Teleop, teleop_settings
from sim.ros.session import Session

RELEASE_TIMEOUT = 0.5  # s of wall time; the page repeats a held key ten times a second


class KeyboardDriver:
    """Passes held keys to the session's Teleop node, and clicks to its Pointer nodes. clock: wall time (s).

    If keys are held and there is no Teleop, it starts one; a Pointer is never started.
    """

    def __init__(self, session: Session, clock: Callable[[], float]) -> None:
        self._session, self._clock = session, clock
        self._last_key_at = 0.0  # wall time of the last key event
        self._has_teleop = False

    def release_if_stale(self) -> None:
        """Release the keys if no key event has come for a while: the page was closed."""
        engine = self._session.engine
        if engine and self._clock() - self._last_key_at > RELEASE_TIMEOUT:
            engine.held = (0.0, 0.0)

    def execute(self, command: dict[str, Any]) -> None:
        """Execute {"drive": [forward, left]} or {"point": [x, y]}; ignore anything else."""
        match command:
            case {"drive": [forward, left]}:
                self.drive(forward, left)
            case {"point": [x, y]}:
                self.point(x, y)

    def drive(self, forward: float, left: float) -> None:
        """Set the keys that are held, each in [-1, 1]."""
        engine, settings = self._session.engine, teleop_settings(self._session.recording.world)
        self._last_key_at, engine.held = self._clock(), (forward, left)
        begun = engine.switches > 0  # before that, the student's Teleop would not exist yet
        exists = self._has_teleop or any(isinstance(node, Teleop) for node in self._session.nodes)
        if (forward or left) and begun and settings and not exists:
            self._has_teleop = True
            self._session.start(Process(Teleop, parameters=settings._asdict()))

    def point(self, x: float, y: float) -> None:
        """The user has clicked there (m): for Pointer nodes, and for the box that one of them puts there."""
        session = self._session
        if session.engine is None or session.truth is None:
            return
        session.engine.pointed, session.warning = (x, y), ""
        place_box = getattr(session.truth.scene, "place_box", None)  # a machine's world has no boxes
        for node in session.nodes:
            if isinstance(node, Pointer) and node.box and place_box and not place_box(node.box, x, y):
                session.warning = f"{node.box} can't be put there: click a free place."
