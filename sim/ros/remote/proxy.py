"""Proxies: each represents a node, publisher, subscription, service or client of the other process.

They are built on rclpy's C++ layer, below its Python classes, so no callback runs for them and no hook takes
them for nodes of this process.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import InvalidHandle
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default

from sim.nanoseconds import Nanoseconds
from sim.ros.rclpy_cpp import cpp, new_node
from sim.ros.remote import events
from sim.ros.transport.endpoint import Sample
from sim.ros.transport.qos import NO_LIMIT
from sim.ros.transport.reader import DataReader
from sim.ros.transport.writer import DataWriter

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

RCLError = cpp.RCLError


class ProxyNode:
    """Represents a node of the other process under the same name in this process's ROS graph."""

    def __init__(self, engine: Engine, namespace: str, name: str) -> None:
        context = engine.rclpy.context.handle
        with context:
            self.handle = new_node(name, namespace, context)
        self.name = self.handle.get_fully_qualified_name()
        # Every node has this service. C++ makes it for real nodes; this one never responds.
        self._description = cpp.TypeDescriptionService(self.handle)
        self.endpoints: set[int] = set()
        self.network = engine.transport.services

    def get_fully_qualified_name(self) -> str:
        """Work like `rclpy.node.Node`."""
        return self.name

    def destroy(self) -> None:
        """Remove the node from the graph."""
        destroy(self._description)
        destroy(self.handle)


class Proxy:
    """Represents a publisher, subscription, service or client of a node of the other process."""

    handle_class: Any

    def __init__(self, node: ProxyNode, type_: type[Any], name: str, profile: QoSProfile) -> None:
        self.node, self.type, self.name, self.qos_profile = node, type_, name, profile
        self.of_action = "/_action/" in name  # belongs to an action, so rclpy's classes don't show it
        with node.handle:
            self.handle = self.handle_class(node.handle, type_, name, profile.get_c_qos_profile())


class ProxyPublisher(Proxy):
    """Publishes here what the publisher of the other process has published."""

    handle_class = cpp.Publisher
    writer: DataWriter


class ProxyReader(DataReader):
    """Receives what the simulated network delivers to a subscription of the other process.

    number: of that subscription. arrivals: the list to which the events for the other process are added.
    """

    def __init__(self, *arguments: Any, number: int, arrivals: list[Any], **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._number, self._arrivals, self._gap = number, arrivals, 0
        if self.profile.liveliness_lease_duration != NO_LIMIT:
            self.liveliness = self

    def receive(self, sample: Sample) -> None:
        """Work like `DataReader.receive`: it goes to the other process."""
        raw, stamp, number, expires = sample
        event = events.MessageDelivered(self._number, raw, stamp, number, expires, self._gap)
        self._arrivals.append(event)
        self._gap = 0

    def on_lost(self, count: int) -> None:
        """Work like `DataReader.on_lost`."""
        self._gap += count

    def assert_liveliness(self, writer: DataWriter) -> None:
        """Work like `LivelinessMonitor.assert_liveliness`: the other process tracks the leases."""
        self._arrivals.append(events.LivelinessDelivered(self._number, writer.sender))

    def matched(self, writer: DataWriter) -> None:
        """Work like `LivelinessMonitor.matched`: the other process notices this itself."""

    unmatched = matched


class ProxySubscription(Proxy):
    """Lets publishers of this process match a subscription of the other one.

    reader: on a simulated network. created_at, program: as those of a `TopicEndpoint`.
    """

    handle_class = cpp.Subscription
    reader: ProxyReader | None = None
    created_at: Nanoseconds = 0
    program = None

    @property
    def profile(self) -> QoSProfile:
        """Work like the attribute of a `TopicEndpoint`."""
        return self.qos_profile

    def take(self) -> bytes | None:
        """The bytes of the next message, or None."""
        network = self.node.network
        return self._taken() if network is None else network.action_message(self, self.node.name, self._taken)

    def _taken(self) -> bytes | None:
        taken = self.handle.take_message(self.type, True)
        return None if taken is None else taken[0]


class ProxyService(Proxy):
    """Takes the requests sent in this process, and sends the responses of the other process."""

    handle_class = cpp.Service

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.srv_type, self.service_name = self.type, self.name
        self.waiting: dict[int, tuple[Any, Any]] = {}  # by key: a request's header and the request

    def take(self) -> tuple[Any, Any] | None:
        """The next request and its header, or None."""
        if self.node.network is None:
            request, header = self.handle.service_take_request(self.type.Request)
        else:
            request, header = self.node.network.request(self) or (None, None)
        return None if header is None else (request, header.request_id)

    def answer(self, key: int, response: Any) -> Any:
        """Send the response to a request, and return the request."""
        header, request = self.waiting.pop(key)
        with contextlib.suppress(RCLError):  # the client may no longer exist
            self.handle.service_send_response(response, header)
        return request


class ProxyClient(Proxy):
    """Sends the requests of a client of the other process to services of this one."""

    handle_class = cpp.Client

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.srv_type = self.type
        self.keys: dict[int, int] = {}  # a request's sequence number here -> its key

    def send(self, key: int, request: Any) -> int:
        """Send a request; returns its sequence number."""
        number = self.handle.send_request(request)
        self.keys[number] = key
        return number

    def take(self) -> tuple[int, Any] | None:
        """The key of a request and the response to it, or None."""
        if self.node.network is None:
            header, response = self.handle.take_response(self.type.Response)
        else:
            header, response = self.node.network.response(self) or (None, None)
        if header is None:
            return None
        return self.keys.pop(header.request_id.sequence_number, None), response


class ProxyAction:
    """Represents an action client or server in the records of goals."""

    def __init__(self, handle: Any) -> None:
        self._handle = handle  # the attribute's name in rclpy's action servers


def proxy_qos(kind: str, name: str, profile: QoSProfile) -> QoSProfile:
    """The QoS of a proxy. A subscription stores one message: it takes none, except for an action's topics."""
    if kind != "subscription" or "/_action/" in name:
        return profile
    adapted = QoSProfile(depth=1, reliability=profile.reliability, durability=profile.durability)
    adapted.liveliness, adapted.deadline = profile.liveliness, profile.deadline
    adapted.liveliness_lease_duration = profile.liveliness_lease_duration
    return adapted


def action_proxy_specs(kind: str, type_: Any, name: str) -> Iterator[tuple[str, type, str, QoSProfile]]:
    """Kind, type, name and QoS of each service and topic that an action client or server consists of."""
    serves, impl = kind == "action server", type_.Impl
    for part, service in (
        ("send_goal", impl.SendGoalService),
        ("cancel_goal", impl.CancelGoalService),
        ("get_result", impl.GetResultService),
    ):
        role = "service" if serves else "client"
        yield role, service, f"{name}/_action/{part}", qos_profile_services_default
    role = "publisher" if serves else "subscription"
    yield role, impl.FeedbackMessage, f"{name}/_action/feedback", QoSProfile(depth=10)
    # A subscription to a latched topic would get the last message at some wall time, so it is volatile here.
    status = qos_profile_action_status_default if serves else QoSProfile(depth=10)
    yield role, impl.GoalStatusMessage, f"{name}/_action/status", status


def destroy(handle: Any) -> None:
    """Free the rclpy object of a handle."""
    with contextlib.suppress(InvalidHandle):
        handle.destroy_when_not_in_use()
