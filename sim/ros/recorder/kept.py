"""What a run keeps of the objects of rclpy and Python: on each hangs one attribute, `_sim`, of its type.

Here are those of services and actions. A publisher has its Writer and a subscription its Reader; an executor
has its Plan, a task its Suspended, a thread its Fiber.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

from sim.evidence import Call, Goal

# A request that was sent: its number among those of its client, and its calls, one for each server.
Request = tuple[int, list[Call]]


@dataclass(slots=True)
class ClientRecord:
    """Of a client."""

    service: str  # resolved name
    type: str
    node: str
    ours: bool  # made by a program that is not the student's; so below
    requests: dict[int, Request] = field(default_factory=dict)  # without a response yet, by number


@dataclass(slots=True)
class ServiceRecord:
    """Of a service. What its queue forgets, the inbox forgets."""

    service: str  # resolved name
    inbox: deque[Request]
    ours: bool
    asked: int = 0  # so many requests were sent when its queue was empty


@dataclass(slots=True)
class ActionRecord:
    """Of an action server, with the goals that it goes on with, by id; or of a client, by their number."""

    action: str  # resolved name
    type: str
    node: str
    ours: bool
    goals: dict[bytes | int, Goal] = field(default_factory=dict)
