"""What a run stores with the endpoints of services and actions."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from sim.evidence import Call, Goal
from sim.nanoseconds import Nanoseconds
from sim.ros.attached import Attached
from sim.ros.fibers.fiber import Program

# A request that was sent: its number among those of its client, and its calls, one for each server.
Request = tuple[int, list[Call]]


@dataclass(slots=True)
class EndpointRecord:
    """Of any endpoint of a service or an action. program: None if it represents one of another process."""

    created_at: Nanoseconds
    program: Program | None
    from_course: bool = False  # created by a program of the course
    server_seen: bool = field(default=False, init=False)  # a client has found that a server is ready

    def has_discovered(self, server: EndpointRecord, now: Nanoseconds) -> bool:
        """Return whether a client has discovered a server. Two programs need time for that, or one waits."""
        same_program = self.program is not None and self.program is server.program
        return self.server_seen or same_program or now > max(self.created_at, server.created_at)

    def reaches(self, servers: Sequence[EndpointRecord], now: Nanoseconds) -> bool:
        """Return whether what a client sends reaches a server, if there is one."""
        return not servers or any(self.has_discovered(server, now) for server in servers)


@dataclass(slots=True, kw_only=True)
class ClientRecord(EndpointRecord):
    """Of a client."""

    service: str  # resolved name
    type: str
    node: str
    requests: dict[int, Request] = field(default_factory=dict)  # without a response yet, by number


@dataclass(slots=True, kw_only=True)
class ServiceRecord(EndpointRecord):
    """Of a service. The inbox drops what its queue drops."""

    service: str  # resolved name
    inbox: deque[Request]
    node: str = ""
    called: bool = False  # a request was sent to it at some time
    has_requests: bool = True  # one may wait in its queue
    unanswered: dict[int, Call] = field(default_factory=dict)  # taken requests, by the id() of their header


@dataclass(slots=True, kw_only=True)
class ActionRecord(EndpointRecord):
    """Of an action server, with its unfinished goals by id; or of a client, with them by number."""

    action: str  # resolved name
    type: str
    node: str
    goals: dict[bytes | int, Goal] = field(default_factory=dict)
    has_news: bool = True  # something may wait in its queues
    swept: Nanoseconds = -1  # when it last looked for goals that have expired


SERVICE = Attached[ServiceRecord]()  # of a Service
CLIENT = Attached[ClientRecord]()  # of a Client
ACTION = Attached[ActionRecord]()  # of an ActionServer and of an ActionClient


class DeclaredEndpoint(NamedTuple):
    """An endpoint of a topic, service or action that a node of this process has, with rclpy's handles."""

    kind: str
    node: Any
    node_name: str
    name: str
    type: type
    qos: Any
    handle: Any
