"""The events that cross between the two sides of a run, each of its own type.

On the wire an event is a list: its word, and its fields in their order. The annotations say what a field
should be; what another process sends may be anything, and is looked at by whoever reads it. Numbers of ends
and nodes, and keys of requests and goals, are chosen by the side that begins to use them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from sim.ros.remote.checked import Nonsense, rows

MOST_EVENTS = 100_000  # in one message
ALL_EVENTS = 3_000_000  # in a run


class End(NamedTuple):
    """A node has declared one end of a topic, service or action; with a QoS profile, but for actions."""

    number: int
    node: int
    node_name: str
    kind: str
    name: str
    type: str
    profile: list[int] | None


class Gone(NamedTuple):
    """Ends were destroyed."""

    numbers: list[int]


class MessageEvent(NamedTuple):
    """A message was published; on a topic of an action by nobody in particular. early: as of `Heard`."""

    node: str
    topic: str
    raw: bytes
    early: bool


class Arrived(NamedTuple):
    """A message has come through the network to a subscription of the other side.

    stamp, count, expires: as of `Sent`. missed: so many have not come before it.
    """

    number: int
    raw: bytes
    stamp: int
    count: int
    expires: int
    missed: int


class Sign(NamedTuple):
    """A publisher's sign of life has come through the network to a subscription of the other side."""

    number: int
    node: str


class Alive(NamedTuple):
    """A publisher of this side says that it is alive."""

    node: str
    topic: str


class Ask(NamedTuple):
    """A client of this side asks a service of the other."""

    key: int
    service: str
    client: str
    raw: bytes


class Answer(NamedTuple):
    """A service of this side answers."""

    key: int
    raw: bytes


class CallMade(NamedTuple):
    """A call between nodes of this side."""

    key: int
    service: str
    type: str
    client: str
    asked: bool
    raw: bytes
    lost: bool


class CallTaken(NamedTuple):
    """A server of this side took a call's request."""

    key: int
    server: str


class CallRaised(NamedTuple):
    """An exception left the callback of its server."""

    key: int
    error: str


class CallAnswered(NamedTuple):
    """A server of this side answered a client of this side."""

    key: int
    raw: bytes


class CallReceived(NamedTuple):
    """A client of this side got its response."""

    key: int


class GoalMade(NamedTuple):
    """A client of this side sent a goal; without one, a server of this side took a goal of the other side."""

    key: int
    action: str
    type: str
    client: str
    id: str
    raw: bytes
    lost: bool


class GoalTaken(NamedTuple):
    """A server of this side took a goal."""

    key: int
    server: str


class GoalEvent(NamedTuple):
    """A goal has another status, or was to be canceled; see `Goal.events`."""

    key: int
    word: str


class GoalFeedback(NamedTuple):
    """A server of this side sent feedback on a goal."""

    key: int
    raw: bytes


class GoalResult(NamedTuple):
    """A server of this side has a goal's result."""

    key: int
    raw: bytes


class GoalAnswered(NamedTuple):
    """A client of this side heard whether its goal is accepted."""

    key: int


class GoalReceived(NamedTuple):
    """A client of this side got its goal's result."""

    key: int


WORDS: dict[type, str] = {
    End: "end",
    Gone: "gone",
    MessageEvent: "message",
    Arrived: "arrived",
    Sign: "sign",
    Alive: "alive",
    Ask: "ask",
    Answer: "answer",
    CallMade: "call",
    CallTaken: "taken",
    CallRaised: "raised",
    CallAnswered: "response",
    CallReceived: "received",
    GoalMade: "goal",
    GoalTaken: "goal taken",
    GoalEvent: "goal event",
    GoalFeedback: "goal feedback",
    GoalResult: "goal result",
    GoalAnswered: "goal answered",
    GoalReceived: "goal received",
}
_TYPES = {word: type_ for type_, word in WORDS.items()}


def row(event: Any) -> list[Any]:
    """An event as it goes over the wire."""
    return [WORDS[type(event)], *event]


class Incoming:
    """The events that come in during one run."""

    def __init__(self) -> None:
        self._count = 0

    def read(self, news: Any) -> Iterator[Any]:
        """The events of these rows; their fields are whatever was sent. Raises Nonsense for what is none."""
        self._count += len(rows(news, "events", MOST_EVENTS))
        if self._count > ALL_EVENTS:
            raise Nonsense(f"more than {ALL_EVENTS} events")
        yield from map(_event, news)


def _event(sent: Any) -> Any:
    word = sent[0] if isinstance(sent, list) and sent else None
    type_ = _TYPES.get(word) if isinstance(word, str) else None
    if type_ is None:
        raise Nonsense("an event of no known kind")
    if len(sent) - 1 != len(type_._fields):
        raise Nonsense(f"the event {word!r} with {len(sent) - 1} parts, not {len(type_._fields)}")
    return type_(*sent[1:])
