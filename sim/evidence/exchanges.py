"""Exchanges between a client and a server: service calls and action goals.

As with messages, the bytes that were sent are stored, and each reader gets a fresh copy. The recorder fills
them in as they happen. Stamps are simulated seconds since the start of the run.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from sim.evidence.rows import Message, Seconds

# Services that every node has: recorded, but not offered as something a student's node does.
NODE_SERVICES = frozenset({
    "describe_parameters", "get_parameter_types", "get_parameters", "list_parameters", "set_parameters",
    "set_parameters_atomically", "get_type_description", "get_logger_levels", "set_logger_levels",
})  # fmt: skip

REJECTED = "rejected"
# A goal's status, in the words of action_msgs/msg/GoalStatus. The last three end it.
ENDINGS = ("succeeded", "canceled", "aborted")
STATUSES = ("accepted", "executing", "canceling", *ENDINGS)
CANCEL_REQUESTED, CANCEL_REJECTED = "cancel requested", "cancel rejected"


def is_node_service(service: str) -> bool:
    """Return whether this full name is that of a service every node has, e.g. "/talker/get_parameters"."""
    return service.rsplit("/", 1)[-1] in NODE_SERVICES


@dataclass(slots=True)
class Call:
    """One request to a service and what became of it; one for each server where several take the request.

    A stamp is None for what did not happen: no server took the request, the server did not answer, the client
    did not wait for the answer or was not spun.
    """

    service: str  # resolved name, e.g. "/add"
    type: str  # e.g. "example_interfaces/srv/AddTwoInts"
    client: str  # fully qualified name of the node, e.g. "/customer"
    raw_request: bytes
    requested: Seconds | None  # the client sent the request
    server: str = ""  # the node that took it
    taken: Seconds | None = None  # its callback began
    answered: Seconds | None = None  # it sent the response
    received: Seconds | None = None  # the client got it
    raw_response: bytes | None = None
    lost: bool = False  # the client had not discovered a server when it sent the request
    raised: str = ""  # type of the exception that left the callback, e.g. "ValueError"
    requested_by_course: bool = False  # the client belongs to a program of the course
    served_by_course: bool = False  # the server that took it belongs to a program of the course

    @property
    def request(self) -> Any:
        """The request object; a fresh copy for each reader."""
        return _decode(f"{self.type}_Request", self.raw_request)

    @property
    def response(self) -> Any:
        """The response object, a fresh copy for each reader; None without one."""
        return _decode(f"{self.type}_Response", self.raw_response)


@dataclass(slots=True)
class Goal:
    """One goal of an action, from the request to the result; one for each server where several take it."""

    action: str  # resolved name, e.g. "/fibonacci"
    type: str  # e.g. "example_interfaces/action/Fibonacci"
    client: str  # fully qualified name of the node, e.g. "/customer"
    id: str  # the goal's UUID, 32 hex digits
    raw_request: bytes
    requested: Seconds | None  # the client sent the goal
    server: str = ""  # the node that took it
    # STATUSES, REJECTED, CANCEL_REQUESTED (by the client) and CANCEL_REJECTED (by the server), with stamps
    events: list[tuple[Seconds, str]] = field(default_factory=list)
    feedback: list[Message] = field(default_factory=list)  # what the server sent about this goal
    answered: Seconds | None = None  # the client received whether it is accepted
    received: Seconds | None = None  # the client got the result
    raw_result: bytes | None = None
    lost: bool = False  # the client had not discovered a server when it sent the goal
    requested_by_course: bool = False  # the client belongs to a program of the course
    served_by_course: bool = False  # the server that took it belongs to a program of the course

    @property
    def request(self) -> Any:
        """The goal message; a fresh copy for each reader."""
        return _decode(f"{self.type}_Goal", self.raw_request)

    @property
    def result(self) -> Any:
        """The result message, a fresh copy for each reader; None before the server has given one."""
        return _decode(f"{self.type}_Result", self.raw_result)

    @property
    def status(self) -> str:
        """The last status, one of STATUSES or REJECTED; "" while no server has decided on the goal."""
        known = [word for _, word in self.events if word == REJECTED or word in STATUSES]
        return known[-1] if known else ""

    @property
    def over(self) -> bool:
        """Return whether the goal has come to an end, or was rejected."""
        return self.status == REJECTED or self.status in ENDINGS

    @property
    def ended(self) -> Seconds | None:
        """Return when the goal came to its end, or was rejected; None while it hasn't."""
        return self.at(self.status) if self.over else None

    def at(self, word: str) -> Seconds | None:
        """Return when the first event of this word came, e.g. "executing"; None if it never did."""
        return next((stamp for stamp, event in self.events if event == word), None)


def _decode(type_: str, raw: bytes | None) -> Any:
    from sim.ros.messages.decoder import decode  # imported late, because numpy is slow

    return None if raw is None else decode(type_, raw)
