"""The ends of topics, services and actions that the nodes of this side have, for the other side."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rclpy.qos import DurabilityPolicy

from sim.ros.messages.codec import type_name
from sim.ros.recorder.calls import alive
from sim.ros.recorder.kept import OwnEnd
from sim.ros.remote.checked import plain_qos
from sim.ros.remote.events import End, Gone
from sim.ros.remote.news import News


class OwnEnds:
    """Those of a list that grows. keys: chosen for them and for their nodes.

    latched: topics on which a late joiner gets earlier messages.
    """

    def __init__(self, ends: list[OwnEnd], keys: Iterator[int]) -> None:
        self._new, self._keys = News(ends), keys
        self._nodes: dict[int, int] = {}  # id of a node's handle -> its number
        self._ends: dict[int, OwnEnd] = {}  # by number, as long as they live
        self.latched: set[str] = set()

    def forget_new(self) -> None:
        """What the other side has declared is none of these."""
        self._new.take()

    def get(self, number: Any) -> OwnEnd | None:
        """The end of this number, if it lives."""
        return self._ends.get(number)

    def new(self) -> Iterator[End]:
        """Those that are new."""
        for end in self._new.take():
            number = next(self._keys)
            self._ends[number] = end
            node = self._nodes.setdefault(id(end.node), next(self._keys))
            profile = None if end.qos is None else plain_qos(end.qos)
            yield End(number, node, end.node_name, end.kind, end.name, type_name(end.type), profile)
            if end.kind == "publisher" and end.qos.durability is DurabilityPolicy.TRANSIENT_LOCAL:
                self.latched.add(end.name)

    def gone(self) -> Iterator[Gone]:
        """Those that were destroyed, in one event."""
        gone = [number for number, end in self._ends.items() if not alive(end.handle)]
        for number in gone:
            del self._ends[number]
        if gone:
            yield Gone(gone)
