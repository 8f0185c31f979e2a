"""Keeps a live picture up to date while a player runs."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, Protocol

from sim.evidence import Recording
from sim.ros.play.telemetry import Telemetry
from sim.ros.session import Session
from sim.world import Scan

RATE_PERIOD = 2.0  # s of simulated time
STATE_PERIOD, GRAPH_PERIOD = 0.25, 1.0  # s of wall time
MAX_CONTACTS = 100  # the newest contacts are shown


class Picture(Protocol):
    """Shows a running simulation. The player calls all methods in the kernel's main thread."""

    # Set by the player. May be called in any thread, with one of {"speed": 2.0}, {"pause": True or False},
    # {"step": True}, {"stop": True}, {"topic": name}, {"graph": True}, {"drive": [forward, left]}, each in
    # [-1, 1], and {"point": [x, y]}, in m.
    on_command: Callable[[dict], None] | None

    def frame(self, stamp: float, poses: list[tuple[float, float, float]], scan: Scan | None) -> None:
        """Show all poses at `stamp` (s) and the latest scan; called at most 30 times a second."""

    def state(self, state: dict) -> None:
        """Show the state; called at most 4 times a second, and whenever speed, paused or ended changes.

        Keys: recording (until now), stamp (s), speed (requested; may be inf), pace (measured), paused,
        topics (a list of dicts of name, type, count of messages, and rate in Hz), contacts (a list of
        [x, y]), ended (None, or [reason, detail]), numbers and topic as `Telemetry.update` returns them, and
        drawing if the world has pens.
        """

    def connections(self, recording: Recording) -> None:
        """Show the graph; called at most once a second, if it was requested and has changed."""

    def finish(self, recording: Recording) -> None:
        """The run has ended: show its recording."""

    def close(self) -> None:
        """Remove the picture."""


class PictureUpdater:
    """Keeps a picture up to date. If the picture raises an exception, the run continues without it."""

    def __init__(self, picture: Picture | None, clock: Callable[[], float]) -> None:
        self._picture, self._clock = picture, clock
        self._last: tuple[float, dict] | None = None  # wall time of the last state; its urgent values
        self.telemetry = Telemetry()
        self._shown: float | None = None  # the stamp of the last frame
        self._graph: tuple[float, int, int] | None = (
            None  # wall time of the last graph; its numbers of nodes and endpoints
        )
        self._sent: deque[tuple[float, dict[str, int]]] = (
            deque()
        )  # (stamp, messages sent on each topic until then)

    def frame(self, session: Session, stamp: float) -> None:
        """Show the world at `stamp`, after everything due at that time has run."""
        if self._picture is None or session.truth is None or stamp == self._shown:
            return
        self._shown, scene = stamp, session.truth.scene
        self._call("frame", stamp, scene.poses, scene.last_scan)

    def state(self, session: Session, stamp: float, pace: float, **urgent: Any) -> None:
        """Show the state, at once if an `urgent` value has changed: speed, paused or ended."""
        now = self._clock()
        known = self._last is not None and self._last[1] == urgent and now - self._last[0] < STATE_PERIOD
        if self._picture is None or known:
            return
        self._last = now, urgent
        contacts = [[contact.x, contact.y] for contact in session.recording.contacts[-MAX_CONTACTS:]]
        state = {"recording": session.recording, "stamp": stamp, "pace": pace}
        state |= {"topics": self._topics(session), "contacts": contacts, "warning": session.warning}
        if session.recording.drawing is not None:
            state["drawing"] = session.recording.drawing
        self._call("state", state | self.telemetry.update(session) | urgent)

    def connections(self, recording: Recording) -> None:
        """Show the graph, which was requested."""
        now, nodes, ends = self._clock(), len(recording.graph.nodes), len(recording.graph.endpoints)
        if self._graph is not None:
            shown_at, *shown = self._graph
            if now - shown_at < GRAPH_PERIOD or shown == [nodes, ends]:  # both numbers only grow
                return
        self._graph = now, nodes, ends
        self._call("connections", recording)

    def finish(self, recording: Recording) -> None:
        """Show the recording if there is something to show, and detach the picture."""
        moved = recording.world is None or recording.path or recording.tracks
        self._call(*(("finish", recording) if moved else ("close",)))
        if self._picture is not None:
            self._picture.on_command = None
        self._picture = None

    def _topics(self, session: Session) -> list[dict[str, Any]]:
        stamp = session.recording.stamp
        if session.engine is not None and (not self._sent or self._sent[-1][0] < stamp):
            self._sent.append((stamp, dict(session.engine.transport.sent)))
        while len(self._sent) > 2 and stamp - self._sent[1][0] >= RATE_PERIOD:
            self._sent.popleft()
        if not self._sent:
            return []
        (since, before), (till, sent) = self._sent[0], self._sent[-1]
        return [
            {
                "name": name,
                "type": type_,
                "count": sent.get(name, 0),
                "rate": (sent.get(name, 0) - before.get(name, 0)) / (till - since) if till > since else 0.0,
            }
            for name, type_ in session.recording.topics.items()
        ]

    def _call(self, method: str, *arguments: Any) -> None:
        if self._picture is None:
            return
        try:
            getattr(self._picture, method)(*arguments)
        except Exception as error:
            self._picture = None
            print(f"There is no picture any more: {type(error).__name__}: {error}")
