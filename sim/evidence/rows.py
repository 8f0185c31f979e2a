"""What happened in a run, one thing a row. Rows are tuples: nothing in them can change after the fact."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from sim.nanoseconds import EPOCH, SECOND

Seconds = float


class Message(NamedTuple):
    """One message as it was published."""

    stamp: Seconds
    topic: str
    type: str  # e.g. "std_msgs/msg/String"
    sender: str  # fully qualified name of the node, e.g. "/talker"
    raw: bytes
    from_course: bool = False  # published by a program of the course, whatever its node is called
    early: bool = (
        False  # sent as its publisher was created, and not latched: no other program can have received it
    )

    @property
    def message(self) -> Any:
        """The message object; a fresh copy for each reader."""
        from sim.ros.messages.decoder import decode  # imported late, because numpy is slow

        return decode(self.type, self.raw)


class LogLine(NamedTuple):
    """One line written with a node's logger."""

    stamp: Seconds
    level: str  # DEBUG, INFO, WARN, ERROR or FATAL
    node: str  # logger name, e.g. "talker" or "robot1.talker"
    text: str
    from_course: bool = False  # written by a program of the course


NOTE = "Note: "  # begins the last line of a traceback that has one


class CallbackError(NamedTuple):
    """An exception that left a callback, a thread or a main()."""

    stamp: Seconds
    node: str
    callback: str  # e.g. "Talker.tick"; the function's name for a main()
    type: str  # e.g. "ZeroDivisionError"
    text: str
    traceback: str  # the student's frames only; at its end a note, if there is one

    @property
    def note(self) -> str:
        """Return what is known about the cause: which function returned a None; "" if nothing is."""
        return self.traceback.rpartition(f"\n{NOTE}")[2].strip() if f"\n{NOTE}" in self.traceback else ""

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


class UndeliveredMessage(NamedTuple):
    """A message published before its publisher and a subscription elsewhere had discovered each other."""

    stamp: Seconds
    node: str  # the node that published it as its publisher or the subscription was created
    topic: str


class ParameterName(NamedTuple):
    """A parameter of a node: one that it was given a value for as it started, or one that it declares.

    It declares a parameter even if the value that it was started with is refused.
    """

    stamp: Seconds
    node: str
    name: str
    declared: bool


CLI_NAME = "_ros2cli"  # of the node of a ros2 command
BUNDLED = "bundled"  # it belongs to a program of a ROS package that the course includes, such as turtlesim
SPUN = "spun"  # an executor has looked at its callbacks
TAKEN_OVER = "taken over"  # a second executor took it away from one that spins
WATCHES = "watches"  # it subscribes to a topic that every node has, such as /parameter_events
CALLS_PUBLISH = "calls publish"  # the code that made its publisher has a call of publish()
RATE = "rate"  # it has a Rate, which is a timer that the node has to be spun for
NAMELESS = "nameless"  # one of two nodes of its name and program was destroyed, and took the name off /rosout
UNFINISHED = "unfinished"  # one of its callbacks had begun and not returned when the run ended
UNMATCHED = "unmatched stamps of"  # and topics: a synchronizer got messages of all, and never a set of them
FACTS = (BUNDLED, CALLS_PUBLISH, NAMELESS, RATE, SPUN, TAKEN_OVER, UNFINISHED, WATCHES)


class NodeFact(NamedTuple):
    """A fact about a node beside what it did: one of FACTS, or UNMATCHED; each once for a node."""

    stamp: Seconds
    node: str
    fact: str


class Departure(NamedTuple):
    """A choice that another order than the usual one made differently, where nothing fixes it."""

    stamp: Seconds
    node: str  # the node or program that it concerns
    kind: str  # turn, callback, message, start or thread
    text: str  # what was different, such as "takes /b before /a"
    id: str  # by which an order names it

    def __str__(self) -> str:
        return f"at {self.stamp:.6g} s, {self.text}"


class Pose(NamedTuple):
    """The robot's true pose (ground truth, map frame)."""

    stamp: Seconds
    x: float
    y: float
    yaw: float


class Ended(NamedTuple):
    """The reason why the run ended: time, goal, finished, error, hang, livelock, blocked or interrupted."""

    reason: str
    stamp: Seconds
    detail: str  # one sentence for the reader


STILL_RUNNING = Ended("running", 0.0, "The run has not ended yet.")


# ROS's own topics: recorded, but not counted as published by a student's node.
INFRASTRUCTURE_TOPICS = frozenset({"/parameter_events", "/rosout", "/clock"})


def since_start(stamp: Any) -> Seconds:
    """The stamp of a message, such as `msg.header.stamp`, as a recording counts: in seconds since the start.

    It is below 0 for what was before the start, as 0 in a message is, which stands for no time at all.
    """
    nanoseconds: int = stamp.sec * SECOND + stamp.nanosec
    return (nanoseconds - EPOCH) / SECOND


def rate(stamps: Sequence[Seconds]) -> float:
    """Mean rate in Hz over a list of stamps; 0.0 when there are fewer than two."""
    return (len(stamps) - 1) / (stamps[-1] - stamps[0]) if len(stamps) > 1 and stamps[-1] > stamps[0] else 0.0


def stamps(messages: Iterable[Message]) -> list[Seconds]:
    """Return the stamps of these messages."""
    return [message.stamp for message in messages]
