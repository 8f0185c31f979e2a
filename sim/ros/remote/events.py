"""The events that the two processes of a run exchange, one type for each kind.

On the wire an event is a list: its name, then its fields in order. The annotations say what a field should
be; a received field may be anything, and the code that uses it validates it. Numbers of endpoints and nodes,
and keys of requests and goals, are chosen by the process that uses them first.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from sim.ros.remote.validation import ProtocolError, valid_list

MAX_EVENTS_PER_MESSAGE = 100_000
MAX_EVENTS_PER_RUN = 3_000_000


class EndpointDeclared(NamedTuple):
    """A node has created an endpoint of a topic, service or action. Actions have no QoS profile."""

    number: int
    node: int
    node_name: str
    kind: str
    name: str
    type: str
    profile: list[int] | None


class EndpointsDestroyed(NamedTuple):
    """Endpoints were destroyed."""

    numbers: list[int]


class MessagePublished(NamedTuple):
    """A message was published. node: empty for a topic of an action. early: as in `sim.evidence.Message`."""

    node: str
    topic: str
    raw: bytes
    early: bool


class MessageDelivered(NamedTuple):
    """The simulated network has delivered a message to a subscription of the other process.

    stamp, count, expires: as of `Sample`. missed: how many were lost just before it.
    """

    number: int
    raw: bytes
    stamp: int
    count: int
    expires: int
    missed: int


class LivelinessDelivered(NamedTuple):
    """The simulated network has delivered a liveliness assertion to a subscription of the other process."""

    number: int
    node: str


class LivelinessAsserted(NamedTuple):
    """A publisher of this process has asserted its liveliness."""

    node: str
    topic: str


class RequestSent(NamedTuple):
    """A client of this process has sent a request to a service of the other."""

    key: int
    service: str
    client: str
    raw: bytes


class ResponseSent(NamedTuple):
    """A service of this process has sent a response to a client of the other."""

    key: int
    raw: bytes


class CallRequested(NamedTuple):
    """A client of this process has sent a request to a service of this process. timed: at a known time."""

    key: int
    service: str
    type: str
    client: str
    timed: bool
    raw: bytes
    lost: bool


class CallStarted(NamedTuple):
    """A server of this process has taken a call's request."""

    key: int
    server: str


class CallRaised(NamedTuple):
    """The server's callback has raised an exception."""

    key: int
    error: str


class CallAnswered(NamedTuple):
    """A server of this process has answered a client of this process."""

    key: int
    raw: bytes


class CallReceived(NamedTuple):
    """A client of this process has received its response."""

    key: int


class GoalRequested(NamedTuple):
    """A client of this process has sent a goal. client: empty for a goal of the other process taken here."""

    key: int
    action: str
    type: str
    client: str
    id: str
    raw: bytes
    lost: bool


class GoalStarted(NamedTuple):
    """A server of this process has taken a goal."""

    key: int
    server: str


class GoalEvent(NamedTuple):
    """A goal's status has changed, or its cancellation was requested; see `Goal.events`."""

    key: int
    event: str


class GoalFeedback(NamedTuple):
    """A server of this process has sent feedback on a goal."""

    key: int
    raw: bytes


class GoalResult(NamedTuple):
    """A server of this process has set a goal's result."""

    key: int
    raw: bytes


class GoalAnswered(NamedTuple):
    """A client of this process has received the acceptance or rejection of its goal."""

    key: int


class GoalReceived(NamedTuple):
    """A client of this process has received its goal's result."""

    key: int


EVENT_NAMES: dict[type, str] = {
    EndpointDeclared: "endpoint",
    EndpointsDestroyed: "destroyed",
    MessagePublished: "message",
    MessageDelivered: "delivered",
    LivelinessDelivered: "liveliness delivered",
    LivelinessAsserted: "liveliness",
    RequestSent: "request",
    ResponseSent: "response",
    CallRequested: "call",
    CallStarted: "call started",
    CallRaised: "call raised",
    CallAnswered: "call answered",
    CallReceived: "call received",
    GoalRequested: "goal",
    GoalStarted: "goal started",
    GoalEvent: "goal event",
    GoalFeedback: "goal feedback",
    GoalResult: "goal result",
    GoalAnswered: "goal answered",
    GoalReceived: "goal received",
}
_TYPES: dict[str, Any] = {name: type_ for type_, name in EVENT_NAMES.items()}


def to_wire(event: Any) -> list[Any]:
    """The list that represents an event on the wire."""
    return [EVENT_NAMES[type(event)], *event]


class EventReader:
    """Decodes the events received during one run."""

    def __init__(self) -> None:
        self._count = 0

    def read(self, received: Any) -> Iterator[Any]:
        """The events of these lists, with unchecked fields. Raises ProtocolError for what is not an event."""
        self._count += len(valid_list(received, "events", MAX_EVENTS_PER_MESSAGE))
        if self._count > MAX_EVENTS_PER_RUN:
            raise ProtocolError(f"more than {MAX_EVENTS_PER_RUN} events")
        yield from map(_from_wire, received)


def _from_wire(received: Any) -> Any:
    name = received[0] if isinstance(received, list) and received else None
    type_ = _TYPES.get(name) if isinstance(name, str) else None
    if type_ is None:
        raise ProtocolError("an event of unknown kind")
    if len(received) - 1 != len(type_._fields):
        raise ProtocolError(f"the event {name!r} with {len(received) - 1} parts, not {len(type_._fields)}")
    return type_(*received[1:])
