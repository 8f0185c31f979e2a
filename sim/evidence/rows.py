"""What happened in a run, one thing a row. Rows are tuples: nothing in them can change after the fact."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from sim.nanoseconds import EPOCH, SECOND
from sim.ros.messages.decoder import decode

Seconds = float


class Heard(NamedTuple):
    """One message as it was sent."""

    stamp: Seconds
    topic: str
    type: str  # e.g. "std_msgs/msg/String"
    sender: str  # fully qualified name of the node, e.g. "/talker"
    raw: bytes
    ours: bool = False  # the program that made the publisher is not the student's, whatever its node's name
    early: bool = False  # sent as its publisher was made, and not latched: no other program can have heard it

    @property
    def message(self) -> Any:
        """The message object; a fresh copy for each reader."""
        return decode(self.type, self.raw)


class LogLine(NamedTuple):
    """One line written with a node's logger."""

    stamp: Seconds
    level: str  # DEBUG, INFO, WARN, ERROR or FATAL
    node: str  # logger name, e.g. "talker" or "robot1.talker"
    text: str
    ours: bool = False  # the program that wrote it is not the student's


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


class BusyLoop(NamedTuple):
    """A loop of a student's that goes on without a pause: it works, and keeps a processor's core busy."""

    stamp: Seconds  # when it was first noticed
    node: str
    place: str  # the callback, thread or main(), and its line


class Unheard(NamedTuple):
    """A message that came too early for a listener of another program: the two had not found each other."""

    stamp: Seconds
    node: str  # who sent it, as its publisher or the subscription was made
    topic: str


class ParameterName(NamedTuple):
    """A parameter of a node: one that it was given a value for as it started, or one that it declares."""

    stamp: Seconds
    node: str
    name: str
    declared: bool


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


def since_start(stamp: Any) -> Seconds:
    """The stamp of a message, such as `msg.header.stamp`, as a recording counts: in seconds since the start.

    It is below 0 for what was before the start, as 0 in a message is, which stands for no time at all.
    """
    return (stamp.sec * SECOND + stamp.nanosec - EPOCH) / SECOND


def rate(stamps: Sequence[Seconds]) -> float:
    """Mean rate in Hz over a list of stamps; 0.0 when there are fewer than two."""
    return (len(stamps) - 1) / (stamps[-1] - stamps[0]) if len(stamps) > 1 and stamps[-1] > stamps[0] else 0.0


def stamps(heard: Iterable[Heard]) -> list[Seconds]:
    """The stamps of some messages."""
    return [h.stamp for h in heard]
