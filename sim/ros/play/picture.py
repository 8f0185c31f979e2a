"""What a player shows while it plays, and to whom."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any, Protocol

from sim.evidence import Recording
from sim.ros.play.readings import Readings
from sim.ros.session import Session
from sim.world import Scan

RATES_OVER = 2.0  # s of simulated time
STATES_EVERY, GRAPHS_EVERY = 0.25, 1.0  # s of wall time
CONTACTS = 100  # the newest that are shown


class Picture(Protocol):
    """Shows a run while it goes on. All its methods are called by the player, in the kernel's main thread."""

    # Set by the player. May be called in any thread, with one of {"speed": 2.0}, {"pause": True or False},
    # {"step": True}, {"stop": True}, {"topic": name}, {"graph": True} and {"drive": [forward, left]}, each in
    # [-1, 1].
    on_command: Callable[[dict], None] | None

    def frame(self, stamp: float, poses: list[tuple[float, float, float]], scan: Scan | None) -> None:
        """Where everything in the world is at `stamp` (s), and what was seen last; 30 a second at most."""

    def state(self, state: dict) -> None:
        """How the run is going; 4 a second at most, and whenever it was paused, sped up or ended.

        Keys: stamp (s), speed (asked for; may be inf), pace (measured), paused, topics (a list of dicts of
        name, type, and rate in Hz), contacts (a list of [x, y]), ended (None, or [reason, detail]), numbers
        and topic as `Readings.update` gives them. Where pens draw: drawing.
        """

    def connections(self, recording: Recording) -> None:
        """Who is connected to whom by now; once a second at most, if it has changed and somebody looks."""

    def finish(self, recording: Recording) -> None:
        """The run is over: show what is left of it."""

    def close(self) -> None:
        """Go, and leave nothing."""


class Show:
    """Keeps a picture up to date. A picture that fails is left alone: the run goes on without it."""

    def __init__(self, picture: Picture | None, clock: Callable[[], float]) -> None:
        self._picture, self._clock = picture, clock
        self._last: tuple[float, dict] | None = None  # wall time of the last state; what was urgent
        self.readings = Readings()
        self._shown: float | None = None  # the stamp of the last frame
        self._graph: tuple[float, int, int] | None = None  # when the last was shown; its nodes and ends
        self._sent: deque[tuple[float, dict[str, int]]] = deque()  # (stamp, messages on each topic by then)

    def frame(self, session: Session, stamp: float) -> None:
        """Show the world at `stamp`, for which all that is due has been done."""
        if self._picture is None or session.truth is None or stamp == self._shown:
            return
        self._shown, scene = stamp, session.truth.scene
        self._tell("frame", stamp, scene.poses, scene.last_scan)

    def state(self, session: Session, stamp: float, pace: float, **urgent: Any) -> None:
        """Show how it goes; at once if something `urgent` has changed: speed, paused and ended."""
        now = self._clock()
        known = self._last is not None and self._last[1] == urgent and now - self._last[0] < STATES_EVERY
        if self._picture is None or known:
            return
        self._last = now, urgent
        contacts = [[contact.x, contact.y] for contact in session.recording.contacts[-CONTACTS:]]
        state = {"stamp": stamp, "pace": pace, "topics": self._topics(session), "contacts": contacts}
        if session.recording.drawing is not None:
            state["drawing"] = session.recording.drawing
        self._tell("state", state | self.readings.update(session) | urgent)

    def connections(self, recording: Recording) -> None:
        """Show the graph, as somebody asks for it."""
        now, nodes, ends = self._clock(), len(recording.graph.nodes), len(recording.graph.endpoints)
        if self._graph is not None:
            shown_at, *shown = self._graph
            if now - shown_at < GRAPHS_EVERY or shown == [nodes, ends]:  # neither ever gets fewer
                return
        self._graph = now, nodes, ends
        self._tell("connections", recording)

    def finish(self, recording: Recording) -> None:
        """Show what is left, if there is anything, and be done."""
        moved = recording.world is None or recording.path or recording.tracks
        self._tell(*(("finish", recording) if moved else ("close",)))
        if self._picture is not None:
            self._picture.on_command = None
        self._picture = None

    def _topics(self, session: Session) -> list[dict[str, Any]]:
        stamp = session.recording.stamp
        if session.engine is not None and (not self._sent or self._sent[-1][0] < stamp):
            self._sent.append((stamp, dict(session.engine.topics.sent)))
        while len(self._sent) > 2 and stamp - self._sent[1][0] >= RATES_OVER:
            self._sent.popleft()
        if not self._sent:
            return []
        (since, before), (till, sent) = self._sent[0], self._sent[-1]
        return [
            {
                "name": name,
                "type": type_,
                "rate": (sent.get(name, 0) - before.get(name, 0)) / (till - since) if till > since else 0.0,
            }
            for name, type_ in session.recording.topics.items()
        ]

    def _tell(self, method: str, *arguments: Any) -> None:
        if self._picture is None:
            return
        try:
            getattr(self._picture, method)(*arguments)
        except Exception as error:
            self._picture = None
            print(f"There is no picture any more: {type(error).__name__}: {error}")
