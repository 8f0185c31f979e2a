"""The proxies of all nodes and endpoints of the other process.

An action has proxies for each of its three services and two topics.
"""

from __future__ import annotations

import contextlib
from collections import defaultdict
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import NameValidationException
from rclpy.qos import QoSProfile
from rclpy.validate_full_topic_name import validate_full_topic_name

from sim.ros.fibers.scheduler import outside_student_code
from sim.ros.recorder.records import ACTION, SERVICE
from sim.ros.remote.proxy import (
    Proxy,
    ProxyAction,
    ProxyClient,
    ProxyNode,
    ProxyPublisher,
    ProxyReader,
    ProxyService,
    ProxySubscription,
    RCLError,
    action_proxy_specs,
    destroy,
    proxy_qos,
)
from sim.ros.remote.validation import (
    MAX_NAME_LENGTH,
    ProtocolError,
    valid_int,
    valid_interface,
    valid_qos,
    valid_text,
)

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine


KINDS: dict[str, type[Proxy]] = {
    "publisher": ProxyPublisher,
    "subscription": ProxySubscription,
    "service": ProxyService,
    "client": ProxyClient,
}
INTERFACES = {"publisher": "msg", "subscription": "msg", "service": "srv", "client": "srv"}
ACTIONS = ("action server", "action client")
MAX_ENDPOINTS = 2_000  # at a time
MAX_ENDPOINTS_PER_RUN = 5_000  # creating one takes up to 10 ms

Declared = tuple[str, ProxyNode, str, type, QoSProfile | None]  # kind, node, name, type, QoS


class Proxies:
    """The proxies of one run, by the numbers and names in the events."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self.nodes: dict[int, ProxyNode] = {}
        self._endpoints: dict[int, list[Proxy]] = {}
        # Services that no node of this process has looked up yet: name and function that creates it.
        self._deferred: dict[int, tuple[str, Callable[[], None]]] = {}
        self.actions: dict[int, ProxyAction] = {}
        self.publishers: dict[str, list[ProxyPublisher]] = defaultdict(list)  # by topic
        self.services: list[ProxyService] = []
        self.clients: dict[str, list[ProxyClient]] = defaultdict(list)  # by service
        self.action_subscriptions: list[ProxySubscription] = []  # of feedback and status topics
        self.wanted = engine.transport.elsewhere  # the other process's subscriptions, by topic
        self.arrivals: list[Any] = []  # deliveries of the simulated network, for the other process
        self._created = 0

    def __contains__(self, number: object) -> bool:
        return isinstance(number, int) and number in self._endpoints

    def __len__(self) -> int:
        return len(self._endpoints)

    @property
    def names(self) -> set[str]:
        """The full names of the other process's nodes."""
        return {node.name for node in self.nodes.values()}

    def declare(
        self, number: Any, node: Any, of: Any, kind: Any, name: Any, type_: Any, profile: Any
    ) -> Declared:
        """Create the proxy of an endpoint that the other process has declared. Raises ProtocolError."""
        number, node = valid_int(number, "a number"), valid_int(node, "a number")
        of = valid_text(of, "a node's name", MAX_NAME_LENGTH)
        name = valid_text(name, "a name", MAX_NAME_LENGTH)
        if kind not in (*INTERFACES, *ACTIONS):
            raise ProtocolError("an endpoint of unknown kind")
        if number in self or not of.startswith("/") or not name.startswith("/"):
            raise ProtocolError(f"the endpoint {name!r} of {of!r}, which is invalid")
        if len(self) >= MAX_ENDPOINTS:
            raise ProtocolError(f"more than {MAX_ENDPOINTS} endpoints of topics, services and actions")
        self._created += 1
        if self._created > MAX_ENDPOINTS_PER_RUN:
            many = f"more than {MAX_ENDPOINTS_PER_RUN} endpoints of topics, services and actions"
            raise ProtocolError(f"{many}, one after the other")
        cls = valid_interface(valid_text(type_, "a type", MAX_NAME_LENGTH), INTERFACES.get(kind, "action"))
        settings = None if kind in ACTIONS else valid_qos(profile)
        namespace, _, short = of.rpartition("/")
        try:
            proxy_node = self._node(node, namespace or "/", short)
            if kind == "service" and not self._is_looked_up(name):
                self._create_later(number, proxy_node, cls, name, settings)
            else:
                self._create(number, proxy_node, kind, cls, name, settings)
        except (ValueError, NameValidationException):
            raise ProtocolError(f"the name {name!r} or {of!r}, which ROS does not allow") from None
        return kind, proxy_node, name, cls, settings

    def _node(self, number: int, namespace: str, name: str) -> ProxyNode:
        """The node with this number, created on first use. Raises ValueError for an invalid name."""
        if number not in self.nodes:
            self.nodes[number] = ProxyNode(self._engine, namespace, name)
        return self.nodes[number]

    def _create(self, number: int, node: ProxyNode, kind: str, type_: type, name: str, profile: Any) -> None:
        """Create the proxies of one endpoint. Raises ValueError for an invalid name."""
        specs = action_proxy_specs(kind, type_, name) if kind in ACTIONS else [(kind, type_, name, profile)]
        proxies = self._endpoints[number] = []
        node.endpoints.add(number)
        for spec_kind, spec_type, spec_name, spec_profile in specs:
            with contextlib.suppress(RCLError):  # the name has another type here, so the two don't match
                qos_profile = proxy_qos(spec_kind, spec_name, spec_profile)
                proxy = KINDS[spec_kind](node, spec_type, spec_name, qos_profile)
                proxies.append(proxy)
                self._add(number, proxy)
        if kind in ACTIONS and proxies:
            action = self.actions[number] = ProxyAction(proxies[0].handle)
            serves = kind == "action server"
            self._engine.recorder.goals.endpoint_created(action, node, name, type_, serves=serves)
        self._engine.waiters.endpoints_changed()

    def _create_later(self, number: int, node: ProxyNode, type_: type, name: str, profile: Any) -> None:
        """Defer a service: creating each node's six parameter services takes a quarter of a short run."""
        validate_full_topic_name(name, is_service=True)
        self._endpoints[number] = []
        node.endpoints.add(number)
        self._deferred[number] = name, partial(self._create, number, node, "service", type_, name, profile)

    def _is_looked_up(self, service: str) -> bool:
        return any(end.kind == "client" and end.name == service for end in self._engine.recorder.declared)

    def seek(self, service: str | None = None) -> None:
        """Create the deferred services that a node looks up: those of this name, or all."""
        with outside_student_code():  # the student's code does not create them
            for number, (name, create) in list(self._deferred.items()):
                if service in (None, name):
                    del self._deferred[number]
                    create()

    def _add(self, number: int, proxy: Proxy) -> None:
        calls = self._engine.recorder.calls
        if isinstance(proxy, ProxyPublisher):
            self.publishers[proxy.name].append(proxy)
            proxy.writer = self._engine.transport.topics.writer(
                proxy.node.handle,
                proxy.handle,
                proxy.type,
                topic=proxy.name,
                profile=proxy.qos_profile,
                sender=proxy.node.name,
            )
        elif isinstance(proxy, ProxyService):
            self.services.append(proxy)
            calls.service_created(proxy)
            SERVICE.of(proxy).node = proxy.node.name
        elif isinstance(proxy, ProxyClient):
            self.clients[proxy.name].append(proxy)
            calls.client_created(proxy, proxy.node, proxy.name)
        elif proxy.of_action:
            self.action_subscriptions.append(proxy)
        elif isinstance(proxy, ProxySubscription):
            proxy.created_at = self._engine.now
            self.wanted[proxy.name].append(proxy)
            if self._engine.transport.links is not None:
                self._connect_network(number, proxy)

    def _connect_network(self, number: int, proxy: ProxySubscription) -> None:
        proxy.reader = self._engine.transport.topics.reader(
            proxy.node.handle,
            proxy.handle,
            proxy.type,
            topic=proxy.name,
            kind=ProxyReader,
            profile=proxy.qos_profile,
            raw=True,
            subscriber=proxy.node.name,
            number=number,
            arrivals=self.arrivals,
        )

    def remove(self, number: int) -> None:
        """Destroy the proxies of an endpoint, and the node of the last one. Raises KeyError."""
        self._deferred.pop(number, None)
        for proxy in self._endpoints.pop(number):
            if isinstance(proxy, ProxyPublisher):
                self.publishers[proxy.name].remove(proxy)
                proxy.writer.close()
            elif isinstance(proxy, ProxyService):
                self.services.remove(proxy)
            elif isinstance(proxy, ProxyClient):
                self.clients[proxy.name].remove(proxy)
            elif proxy.of_action:
                self.action_subscriptions.remove(proxy)
            elif isinstance(proxy, ProxySubscription):
                self.wanted[proxy.name].remove(proxy)
                if proxy.reader is not None:
                    proxy.reader.close()
            destroy(proxy.handle)
        self.actions.pop(number, None)
        for key, node in list(self.nodes.items()):
            node.endpoints.discard(number)
            if not node.endpoints:
                self.nodes.pop(key).destroy()
        self._engine.waiters.endpoints_changed()

    def publisher(self, node: str, topic: str, *, newest: bool = False) -> ProxyPublisher | None:
        """The oldest or newest publisher of this node on a topic. For a topic of an action, of any node."""
        found = _of_node(self.publishers.get(topic, ()), node)
        return found[-newest] if found else None

    def client(self, node: str, service: str) -> ProxyClient | None:
        """The client of a service that this node has. For a service of an action, of any node."""
        found = _of_node(self.clients.get(service, ()), node)
        return found[0] if found else None

    def action(self, node: str, name: str, type_: str) -> ProxyAction | None:
        """The action client or server that this node has."""
        known = ((proxy, ACTION.of(proxy)) for proxy in self.actions.values())
        wanted = (proxy for proxy, of in known if (of.action, of.type, of.node) == (name, type_, node))
        return next(wanted, None)

    def close(self) -> None:
        """Destroy all proxies."""
        for number in list(self._endpoints):
            self.remove(number)


def _of_node(proxies: Iterable[Proxy], node: str) -> list[Any]:
    return [proxy for proxy in proxies if proxy.of_action or proxy.node.name == node]
