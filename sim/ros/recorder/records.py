"""What a run stores with objects of rclpy and Python: one attribute, `_sim`, of one type per kind of object.

Service: ServiceRecord, Client: ClientRecord, ActionServer and ActionClient: ActionRecord, all here.
Publisher: Writer, Subscription: Reader, EventHandler of an event of time: EventCounts, in sim.ros.transport.
Executor: SimExecutor, Task: TaskState, ROSClock and JumpHandle: ClockSwitch, in sim.ros.engine.
Thread: Fiber, in sim.ros.fibers.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from sim.evidence import Call, Goal
from sim.nanoseconds import Nanoseconds
from sim.ros.fibers.fiber import Program

# A request that was sent: its number among those of its client, and its calls, one for each server.
Request = tuple[int, list[Call]]


@dataclass(slots=True)
class EndRecord:
    """Of any end of a service or an action. program: None for an end that stands for another process's."""

    made: Nanoseconds
    program: Program | None
    from_course: bool = False  # made by a program that is not the student's
    looked: bool = field(default=False, init=False)  # a client that was told that a server is there

    def knows(self, server: EndRecord, now: Nanoseconds) -> bool:
        """Whether a client has discovered a server. Two programs need time for that, or one waits for it."""
        at_home = self.program is not None and self.program is server.program
        return self.looked or at_home or now > max(self.made, server.made)

    def reaches(self, servers: Sequence[EndRecord], now: Nanoseconds) -> bool:
        """Whether what a client sends gets to a server; where there is none, that is no question."""
        return not servers or any(self.knows(server, now) for server in servers)


@dataclass(slots=True, kw_only=True)
class ClientRecord(EndRecord):
    """Of a client."""

    service: str  # resolved name
    type: str
    node: str
    requests: dict[int, Request] = field(default_factory=dict)  # without a response yet, by number


@dataclass(slots=True, kw_only=True)
class ServiceRecord(EndRecord):
    """Of a service. What its queue forgets, the inbox forgets."""

    service: str  # resolved name
    inbox: deque[Request]
    node: str = ""
    called: bool = False  # a request was sent to it at some time
    has_requests: bool = True  # one may wait in its queue


@dataclass(slots=True, kw_only=True)
class ActionRecord(EndRecord):
    """Of an action server, with the goals that it goes on with, by id; or of a client, by their number."""

    action: str  # resolved name
    type: str
    node: str
    goals: dict[bytes | int, Goal] = field(default_factory=dict)
    has_news: bool = True  # something may wait in its queues
    swept: Nanoseconds = -1  # when it last looked for goals that have expired


class OwnEnd(NamedTuple):
    """One end of a topic, service or action that a node of this process has, with rclpy's own handles."""

    kind: str
    node: Any
    node_name: str
    name: str
    type: type
    qos: Any
    handle: Any
