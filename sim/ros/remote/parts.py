"""What puppets are made of: a node, and its publishers, subscriptions, services and clients.

They are made below rclpy's classes: no callback of theirs runs here, and no hook takes them for nodes of this
process.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default

from sim.ros.engine.delivery.qos import NO_LIMIT
from sim.ros.engine.delivery.reader import Reader, Sent
from sim.ros.engine.delivery.writer import Writer
from sim.ros.remote import events

if TYPE_CHECKING:
    from sim.ros.engine.engine import Engine

RCLError = _rclpy.RCLError


class PuppetNode:
    """A node of the other side; in the ROS graph of this one it has the same name."""

    def __init__(self, engine: Engine, namespace: str, name: str) -> None:
        context = engine.context.handle
        with context:
            self.handle = _rclpy.Node(name, namespace, context, None, False, False)
        self.name = self.handle.get_fully_qualified_name()
        # Every node has this service, made by C++ where no hook sees it. Nobody answers at this one.
        self._description = _rclpy.TypeDescriptionService(self.handle)
        self.ends: set[int] = set()
        self.post = engine.post

    def get_fully_qualified_name(self) -> str:
        """As rclpy's nodes."""
        return self.name

    def destroy(self) -> None:
        """Take it out of the graph."""
        destroy(self._description)
        destroy(self.handle)


class Part:
    """One publisher, subscription, service or client of a node of the other side."""

    made_by: Any

    def __init__(self, node: PuppetNode, type_: type, name: str, profile: QoSProfile) -> None:
        self.node, self.type, self.name, self.qos_profile = node, type_, name, profile
        self.of_action = "/_action/" in name  # a part of one: rclpy's classes show nothing of it
        with node.handle:
            self.handle = self.made_by(node.handle, type_, name, profile.get_c_qos_profile())


class PuppetPublisher(Part):
    """Publishes here what the other side's publisher has published."""

    made_by = _rclpy.Publisher
    writer: Writer


class PuppetReader(Reader):
    """Where the way through the network to a subscription of the other side ends.

    number: of that subscription. arrivals: the events for the other side are put there.
    """

    def __init__(self, *end: Any, number: int, arrivals: list[Any], **more: Any) -> None:
        super().__init__(*end, **more)
        self._number, self._arrivals, self._gap = number, arrivals, 0
        self.receive = self._pass_on
        if self.profile.liveliness_lease_duration != NO_LIMIT:
            self.liveliness = self

    def _pass_on(self, sent: Sent) -> None:
        raw, stamp, number, expires = sent
        event = events.Arrived(self._number, raw, stamp, number, expires, self._gap)
        self._arrivals.append(event)
        self._gap = 0

    def missed(self, count: int) -> None:
        """As Reader."""
        self._gap += count

    def sign(self, writer: Writer) -> None:
        """As Liveliness: the other side counts."""
        self._arrivals.append(events.Sign(self._number, writer.sender))

    def met(self, writer: Writer) -> None:
        """As Liveliness; the other side sees that by itself."""

    gone = met


class PuppetSubscription(Part):
    """Makes publishers here find who listens on the other side."""

    made_by = _rclpy.Subscription
    reader: PuppetReader | None = None

    def take(self) -> bytes | None:
        """The next message's bytes."""
        post = self.node.post
        return self._taken() if post is None else post.news(self, self.node.name, self._taken)

    def _taken(self) -> bytes | None:
        taken = self.handle.take_message(self.type, True)
        return None if taken is None else taken[0]


class PuppetService(Part):
    """Takes the requests that are made here, and gives the other side's responses."""

    made_by = _rclpy.Service

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.srv_type, self.service_name = self.type, self.name
        self.waiting: dict[int, tuple[Any, Any]] = {}  # by key on the wire: a request's header, the request

    def take(self) -> tuple[Any, Any] | None:
        """The next request and its header."""
        if self.node.post is None:
            request, header = self.handle.service_take_request(self.type.Request)
        else:
            request, header = self.node.post.request(self) or (None, None)
        return None if header is None else (request, header.request_id)

    def answer(self, key: int, response: Any) -> Any:
        """Send the response to a request, which is given back."""
        header, request = self.waiting.pop(key)
        with contextlib.suppress(RCLError):  # the client may have gone away
            self.handle.service_send_response(response, header)
        return request


class PuppetClient(Part):
    """Asks services here what the other side's client has asked."""

    made_by = _rclpy.Client

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.srv_type = self.type
        self.asked: dict[int, int] = {}  # a request's number here, and its key on the wire

    def ask(self, key: int, request: Any) -> int:
        """Send a request; gives its number."""
        number = self.handle.send_request(request)
        self.asked[number] = key
        return number

    def take(self) -> tuple[int, Any] | None:
        """The next response, and the key of its request."""
        if self.node.post is None:
            header, response = self.handle.take_response(self.type.Response)
        else:
            header, response = self.node.post.response(self) or (None, None)
        if header is None:
            return None
        return self.asked.pop(header.request_id.sequence_number, None), response


def parts_of_action(kind: str, type_: Any, name: str) -> Iterator[tuple[str, type, str, QoSProfile]]:
    """Kind, type, name and settings of each part that one end of an action has."""
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
    # A late joiner of a latched topic gets its last message at some wall time: here only publishers are.
    status = qos_profile_action_status_default if serves else QoSProfile(depth=10)
    yield role, impl.GoalStatusMessage, f"{name}/_action/status", status


def destroy(handle: Any) -> None:
    """Free what rclpy has this handle for."""
    with contextlib.suppress(InvalidHandle):
        handle.destroy_when_not_in_use()
