"""Puppets: they stand in this process for the nodes of another one, and for what these have declared.

They are made below rclpy's classes: no callback of theirs runs here, and no hook takes them for nodes of this
process. An action is made of what ROS makes it of: three services and two topics.
"""

from __future__ import annotations

import contextlib
from collections import Counter, defaultdict
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import (
    QoSProfile,
    qos_profile_action_status_default,
    qos_profile_services_default,
)

if TYPE_CHECKING:
    from sim.ros.engine import Engine

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

    def get_fully_qualified_name(self) -> str:
        """As rclpy's nodes."""
        return self.name

    def destroy(self) -> None:
        """Take it out of the graph."""
        _destroy(self._description)
        _destroy(self.handle)


class Part:
    """One publisher, subscription, service or client of a node of the other side."""

    made_by: Any

    def __init__(self, node: PuppetNode, type_: type, name: str, profile: QoSProfile) -> None:
        self.node, self.type, self.name, self.qos_profile = node, type_, name, profile
        with node.handle:
            self.handle = self.made_by(node.handle, type_, name, profile.get_c_qos_profile())

    @property
    def of_action(self) -> bool:
        """Whether it is a part of an action, of which rclpy's classes show nothing."""
        return "/_action/" in self.name


class PuppetPublisher(Part):
    """Publishes here what the other side's publisher has published."""

    made_by = _rclpy.Publisher

    @property
    def topic_name(self) -> str:
        """As rclpy's publishers."""
        return self.name

    def wait_for_all_acked(self, timeout: Any) -> bool:
        """As rclpy's publishers."""
        return self.handle.wait_for_all_acked(timeout._duration_handle)


class PuppetSubscription(Part):
    """Makes publishers here find who listens on the other side."""

    made_by = _rclpy.Subscription

    def take(self) -> bytes | None:
        """The next message's bytes."""
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
        request, header = self.handle.service_take_request(self.type.Request)
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
        header, response = self.handle.take_response(self.type.Response)
        if header is None:
            return None
        return self.asked.pop(header.request_id.sequence_number, None), response


class PuppetAction:
    """One end of an action, for the records of goals."""

    def __init__(self, handle: Any) -> None:
        self._handle = handle  # where rclpy's action servers have theirs


KINDS: dict[str, type[Part]] = {
    "publisher": PuppetPublisher,
    "subscription": PuppetSubscription,
    "service": PuppetService,
    "client": PuppetClient,
}
ACTIONS = ("action server", "action client")


def _parts_of_action(kind: str, type_: Any, name: str) -> Iterator[tuple[str, type, str, QoSProfile]]:
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


class Puppets:
    """All puppets of one run, found by what the events on the wire call them."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self.nodes: dict[int, PuppetNode] = {}
        self._ends: dict[int, list[Part]] = {}
        self.actions: dict[int, PuppetAction] = {}
        self.publishers: dict[str, list[PuppetPublisher]] = defaultdict(list)  # by topic
        self.services: list[PuppetService] = []
        self.clients: dict[str, list[PuppetClient]] = defaultdict(list)  # by service
        self.listening: list[PuppetSubscription] = []  # parts of actions: their messages are taken here
        self.wanted: Counter[str] = Counter()  # subscriptions of the other side, by topic

    def __contains__(self, number: object) -> bool:
        return isinstance(number, int) and number in self._ends

    def __len__(self) -> int:
        return len(self._ends)

    def node(self, number: int, namespace: str, name: str) -> PuppetNode:
        """The node of this number; the first time it is made. Raises ValueError for an impossible name."""
        if number not in self.nodes:
            self.nodes[number] = PuppetNode(self._engine, namespace, name)
        return self.nodes[number]

    def make(self, number: int, node: PuppetNode, kind: str, type_: type, name: str, profile: Any) -> None:
        """Make what stands for one end of a topic, service or action. Raises ValueError for a bad name."""
        asked = _parts_of_action(kind, type_, name) if kind in ACTIONS else [(kind, type_, name, profile)]
        parts = self._ends[number] = []
        node.ends.add(number)
        for what, part_type, part_name, part_profile in asked:
            with contextlib.suppress(RCLError):  # the name has another type here: they don't hear each other
                part = KINDS[what](node, part_type, part_name, self._suited(what, part_name, part_profile))
                parts.append(part)
                self._enter(part)
        if kind in ACTIONS and parts:
            action = self.actions[number] = PuppetAction(parts[0].handle)
            serves = kind == "action server"
            self._engine.recorder.goals.end_made(action, node, name, type_, serves=serves)
        self._engine.endpoints_changed()

    def _suited(self, kind: str, name: str, profile: QoSProfile) -> QoSProfile:
        if kind != "subscription" or "/_action/" in name:
            return profile
        short = QoSProfile(depth=1, reliability=profile.reliability, durability=profile.durability)
        short.liveliness, short.deadline = profile.liveliness, profile.deadline
        short.liveliness_lease_duration = profile.liveliness_lease_duration
        return short

    def _enter(self, part: Part) -> None:
        calls = self._engine.recorder.calls
        if isinstance(part, PuppetPublisher):
            self.publishers[part.name].append(part)
        elif isinstance(part, PuppetService):
            self.services.append(part)
            calls.service_made(part)
        elif isinstance(part, PuppetClient):
            self.clients[part.name].append(part)
            calls.client_made(part, part.node, part.name)
            self._engine.has_clients = True
        elif part.of_action:
            self.listening.append(part)
        else:
            self.wanted[part.name] += 1

    def remove(self, number: int) -> None:
        """Destroy what stands for one end, and the node with its last one. Raises KeyError for none."""
        for part in self._ends.pop(number):
            if isinstance(part, PuppetPublisher):
                self.publishers[part.name].remove(part)
            elif isinstance(part, PuppetService):
                self.services.remove(part)
            elif isinstance(part, PuppetClient):
                self.clients[part.name].remove(part)
            elif part.of_action:
                self.listening.remove(part)
            else:
                self.wanted[part.name] -= 1
            _destroy(part.handle)
        self.actions.pop(number, None)
        for key, node in list(self.nodes.items()):
            node.ends.discard(number)
            if not node.ends:
                self.nodes.pop(key).destroy()
        self._engine.endpoints_changed()

    def publisher(self, node: str, topic: str) -> PuppetPublisher | None:
        """The publisher of this node on a topic; of any node, for a topic of an action."""
        found = [part for part in self.publishers.get(topic, ()) if part.of_action or part.node.name == node]
        return found[0] if found else None

    def client(self, node: str, service: str) -> PuppetClient | None:
        """The client of a service that this node has; of any node, for a service of an action."""
        found = [part for part in self.clients.get(service, ()) if part.of_action or part.node.name == node]
        return found[0] if found else None

    def action(self, node: str, name: str, type_: str) -> PuppetAction | None:
        """The end of an action that this node has."""
        found = (action for action in self.actions.values() if action._sim_identity == (name, type_, node))
        return next(found, None)

    def close(self) -> None:
        """Destroy all."""
        for number in list(self._ends):
            self.remove(number)


def _destroy(handle: Any) -> None:
    with contextlib.suppress(InvalidHandle):
        handle.destroy_when_not_in_use()
