"""The graph of a run: its nodes, and the ends of topics, services and actions that they declared."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple


class Endpoint(NamedTuple):
    """One end of a topic, service or action, as a node declared it."""

    kind: str  # publisher, subscription, service, client, action server, action client
    node: str
    name: str  # resolved name, e.g. "/robot1/cmd_vel"
    type: str
    qos: dict[str, Any]  # see `sim.evidence.qos`; {} for actions
    from_course: bool = False  # created by a program of the course


class TimerInfo(NamedTuple):
    """One timer as a node created it."""

    node: str
    period: float  # simulated seconds
    callback: str


@dataclass
class Graph:
    """All nodes of a run and what they were connected to."""

    nodes: list[str] = field(default_factory=list)
    endpoints: list[Endpoint] = field(default_factory=list)
    timers: list[TimerInfo] = field(default_factory=list)

    def publishers(self, topic: str | None = None) -> list[Endpoint]:
        """Publishers, of one topic or of all."""
        return self.ends("publisher", topic)

    def subscriptions(self, topic: str | None = None) -> list[Endpoint]:
        """Subscriptions, of one topic or of all."""
        return self.ends("subscription", topic)

    def ends(self, kind: str, name: str | None = None) -> list[Endpoint]:
        """Ends of one kind (see `Endpoint`), of one topic, service or action or of all."""
        return [e for e in self.endpoints if e.kind == kind and name in (None, e.name)]
