"""The topic, service and action endpoints of this process's nodes, as events for the other process."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rclpy.qos import DurabilityPolicy

from sim.ros.messages.codec import type_name
from sim.ros.recorder.calls import alive
from sim.ros.recorder.records import DeclaredEndpoint
from sim.ros.remote.events import EndpointDeclared, EndpointsDestroyed
from sim.ros.remote.new_items import NewItems
from sim.ros.remote.validation import qos_to_list


class LocalEndpoints:
    """Follows a list of endpoints that only grows, and notices which of them were destroyed.

    keys: supplies a number for each endpoint and each node.
    latched: topics whose late subscribers get earlier messages.
    """

    def __init__(self, endpoints: list[DeclaredEndpoint], keys: Iterator[int]) -> None:
        self._new, self._keys = NewItems(endpoints), keys
        self._nodes: dict[int, int] = {}  # id of a node's handle -> its number
        self._endpoints: dict[int, DeclaredEndpoint] = {}  # by number, while they exist
        self.latched: set[str] = set()

    def skip_new(self) -> None:
        """Ignore endpoints that were just added on behalf of the other process."""
        self._new.take()

    def get(self, number: Any) -> DeclaredEndpoint | None:
        """The endpoint with this number, or None if it does not exist."""
        return self._endpoints.get(number)

    def declared(self) -> Iterator[EndpointDeclared]:
        """An event for each new endpoint."""
        for endpoint in self._new.take():
            number = next(self._keys)
            self._endpoints[number] = endpoint
            node = self._nodes.setdefault(id(endpoint.node), next(self._keys))
            profile = None if endpoint.qos is None else qos_to_list(endpoint.qos)
            yield EndpointDeclared(
                number,
                node,
                endpoint.node_name,
                endpoint.kind,
                endpoint.name,
                type_name(endpoint.type),
                profile,
            )
            if endpoint.kind == "publisher" and endpoint.qos.durability is DurabilityPolicy.TRANSIENT_LOCAL:
                self.latched.add(endpoint.name)

    def destroyed(self) -> Iterator[EndpointsDestroyed]:
        """One event with the endpoints that were destroyed, if there are any."""
        numbers = [number for number, end in self._endpoints.items() if not alive(end.handle)]
        for number in numbers:
            del self._endpoints[number]
        if numbers:
            yield EndpointsDestroyed(numbers)
