"""What a run leaves behind: evidence as plain data.

A recording holds no live node. Messages are kept as the bytes that were sent (CDR, the format on the wire),
so nothing can change after the fact, and are turned back into message objects when somebody looks at them.

Stamps are simulated seconds since the start of the run. Poses are in the `map` frame: metres, and radians in
(-pi, pi].
"""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sim.exchanges import Call, Goal, is_node_service
from sim.graph import Endpoint as Endpoint
from sim.graph import Graph
from sim.graph import TimerInfo as TimerInfo
from sim.world import Contact, World

if TYPE_CHECKING:
    from sim.view.replay import Replay

Seconds = float


class Heard(NamedTuple):
    """One message as it was sent."""

    stamp: Seconds
    topic: str
    type: str  # e.g. "std_msgs/msg/String"
    sender: str  # fully qualified name of the node, e.g. "/talker"
    raw: bytes

    @property
    def message(self) -> Any:
        """The message object; a fresh copy for each reader."""
        from sim.ros.codec import decode

        return decode(self.type, self.raw)


class LogLine(NamedTuple):
    """One line written with a node's logger."""

    stamp: Seconds
    level: str  # DEBUG, INFO, WARN, ERROR or FATAL
    node: str  # logger name, e.g. "talker" or "robot1.talker"
    text: str


class CallbackError(NamedTuple):
    """An exception that left a callback, a thread or a main()."""

    stamp: Seconds
    node: str
    callback: str  # e.g. "Talker.tick"; the function's name for a main()
    type: str  # e.g. "ZeroDivisionError"
    text: str
    traceback: str  # the student's frames only

    @property
    def says(self) -> str:
        """A colon and its text, to end a sentence with; nothing where it has no text."""
        return f": {self.text}" if self.text.strip() else ""


class CallbackRun(NamedTuple):
    """One execution of a callback; `duration` is the simulated time it held its executor."""

    stamp: Seconds
    duration: Seconds
    node: str
    callback: str
    kind: str  # timer, subscription, service, client, action or task


class Pose(NamedTuple):
    """Where the robot really was (ground truth, map frame)."""

    stamp: Seconds
    x: float
    y: float
    yaw: float


class Ended(NamedTuple):
    """Why the run ended: time, goal, finished, error, hang, livelock, blocked or interrupted."""

    reason: str
    stamp: Seconds
    detail: str  # one sentence for the reader


STILL_RUNNING = Ended("running", 0.0, "The run has not ended yet.")


# Chatter of ROS itself: recorded, but not offered as something a student's node said.
INFRASTRUCTURE_TOPICS = frozenset({"/parameter_events", "/rosout", "/clock"})


@dataclass
class Recording:
    """Everything one run left behind. `until` sees it while it grows; checks see it when it is complete."""

    world: World | None = None  # None for a run without a robot
    seconds: Seconds = 0.0
    seed: int = 0
    stamp: Seconds = 0.0  # how far the run has come
    heard: list[Heard] = field(default_factory=list)
    calls: list[Call] = field(default_factory=list)  # of services, in the order they were asked
    goals: list[Goal] = field(default_factory=list)  # of actions, in the order they were asked
    path: list[Pose] = field(default_factory=list)
    # the same of everything else that moves, by the name of its `Body`: other robots, boxes, links
    tracks: dict[str, list[Pose]] = field(default_factory=dict)
    contacts: list[Contact] = field(default_factory=list)
    logs: list[LogLine] = field(default_factory=list)
    errors: list[CallbackError] = field(default_factory=list)
    callbacks: list[CallbackRun] = field(default_factory=list)
    prints: list[tuple[Seconds, str]] = field(default_factory=list)  # what went to stdout
    stderr: str = ""  # what went there, other than log lines
    graph: Graph = field(default_factory=Graph)
    ended: Ended = STILL_RUNNING

    def messages(self, topic: str | None = None, sender: str | None = None) -> list[Heard]:
        """Messages in the order they were sent; of one topic, of one node, or all but ROS's own chatter.

        topic: resolved name with its leading slash, e.g. "/cmd_vel". sender: e.g. "/talker".
        """
        wanted = self.heard if sender is None else [h for h in self.heard if h.sender == sender]
        if topic is None:
            return [h for h in wanted if h.topic not in INFRASTRUCTURE_TOPICS]
        return [h for h in wanted if h.topic == topic]

    def calls_of(
        self, service: str | None = None, client: str | None = None, server: str | None = None
    ) -> list[Call]:
        """Calls in the order they were asked; of one service, or all but those that every node has.

        service: resolved name, e.g. "/add". client, server: a node that asked or answered, e.g. "/adder".
        """
        return [
            call
            for call in self.calls
            if (not is_node_service(call.service) if service is None else call.service == service)
            and client in (None, call.client)
            and server in (None, call.server)
        ]

    def goals_of(
        self, action: str | None = None, client: str | None = None, server: str | None = None
    ) -> list[Goal]:
        """Goals in the order they were asked; of one action, of one client or server, or all."""
        return [
            goal
            for goal in self.goals
            if action in (None, goal.action)
            and client in (None, goal.client)
            and server in (None, goal.server)
        ]

    @property
    def topics(self) -> dict[str, str]:
        """Topic name to type, for every topic with a publisher, sorted by name."""
        return dict(sorted({e.name: e.type for e in self.graph.publishers()}.items()))

    @functools.cached_property
    def digest(self) -> str:
        """One hex string for the whole run: equal runs have equal digests.

        What was printed is left out: it is for the screen, and may hold addresses, which differ every time.
        """
        digest = hashlib.blake2b(digest_size=16)
        for heard in self.heard:
            digest.update(
                f"{heard.stamp!r} {heard.topic} {heard.type} {heard.sender} {len(heard.raw)} ".encode()
            )
            digest.update(heard.raw)
        for exchange in (*self.calls, *self.goals):
            digest.update(repr(exchange).encode())
        digest.update(json.dumps(self._evidence(), sort_keys=True).encode())
        return digest.hexdigest()

    def _evidence(self) -> dict[str, Any]:
        return {
            "seconds": self.seconds,
            "seed": self.seed,
            "path": self.path,
            "tracks": self.tracks,
            "contacts": self.contacts,
            "logs": self.logs,
            "errors": [error._replace(traceback="") for error in self.errors],
            "callbacks": self.callbacks,
            "graph": asdict(self.graph),
            "ended": self.ended,
        }

    def save(self, path: str | Path) -> Path:
        """Write an MCAP file: ROS's own recording format, which `ros2 bag` and Foxglove also open."""
        from sim.ros.storage import write

        return write(self, Path(path))

    @staticmethod
    def load(path: str | Path) -> Recording:
        """Read a file written by `save`. Raises StorageError with one clear sentence if it isn't one."""
        from sim.ros.storage import read

        return read(Path(path))

    def replay(self, *, speed: float = 1.0) -> Replay:
        """The run as a player with a scrub bar; it stays in the saved notebook and in pages made from it.

        speed: simulated seconds per second, to begin with. Raises ValueError if it isn't above 0.
        """
        from sim.view.replay import replay

        return replay(self, speed=speed)

    def __repr__(self) -> str:
        return (
            f"<Recording of {self.stamp:g} s: {len(self.heard)} messages on {len(self.topics)} topics, "
            f"{len(self.logs)} log lines, {len(self.errors)} errors, ended: {self.ended.reason}>"
        )


def rate(stamps: Sequence[Seconds]) -> float:
    """Mean rate in Hz over a list of stamps; 0.0 when there are fewer than two."""
    return (len(stamps) - 1) / (stamps[-1] - stamps[0]) if len(stamps) > 1 and stamps[-1] > stamps[0] else 0.0


def stamps(heard: Iterable[Heard]) -> list[Seconds]:
    """The stamps of some messages."""
    return [h.stamp for h in heard]
