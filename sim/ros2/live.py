"""The system of nodes in other processes on this machine, in real time."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from typing import Any

import rclpy
from rclpy.node import Node, NodeNameNonExistentError
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions

from sim import ros_environment
from sim.evidence import Endpoint
from sim.evidence.qos import settings
from sim.ros.messages.codec import message_class
from sim.ros2 import domains
from sim.ros2.system import POLL, Known, NodeTask, Output, ReceivedMessage, System, T, with_node
from sim.ros2.uninterrupted import uninterrupted

SETTLING_TIME = 0.5  # s without a change of the graph, as in the official tools
POLL_GRAPH = 0.05  # s between two checks of the graph
MAX_RETRIES = 30  # to find a name: another process may be slow
MAX_SETTLING = 10  # times the settling time, while a participant exists whose endpoints are not known yet
_Ends = list[tuple[str, list[str]]]  # their names and types


class LiveSystem(System):
    """The nodes of one ROS domain; a context manager.

    print_line: prints a line of the output. print_error: prints hints on stderr. settling_time: seconds
    without a change until the graph counts as complete. spin_time: seconds of discovery, whatever changes.
    """

    def __init__(
        self,
        print_line: Callable[[str], None] = print,
        print_error: Callable[[str], None] = lambda _: None,
        settling_time: float = SETTLING_TIME,
        spin_time: float | None = None,
    ) -> None:
        super().__init__(print_line)
        self._print_error, self._settling_time = print_error, settling_time
        self._spin_time = spin_time

    def __enter__(self) -> LiveSystem:
        self.domain = domains.selected_domain()
        ros_environment.open_to_this_machine(self.domain)
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        self._node = rclpy.create_node(
            f"_ros2cli_{os.getpid()}", start_parameter_services=False, enable_rosout=False
        )
        self._discover()
        return self

    def __exit__(self, *exception: object) -> None:
        self._node.destroy_node()
        rclpy.try_shutdown()

    def _discover(self) -> None:
        """Wait until no more nodes are discovered. Print a hint if there are none."""
        if self._spin_time is None:
            self.wait_for_graph()
        else:
            end = time.monotonic() + self._spin_time
            while (left := end - time.monotonic()) > 0:
                rclpy.spin_once(self._node, timeout_sec=left)
        if not self.nodes and (hint := domains.no_nodes_hint(self.domain)):
            self._print_error(hint)

    def wait_for_graph(self) -> None:
        """Wait until the graph no longer changes."""
        began = time.monotonic()
        known: Any = None
        quiet = 0  # checks without a change; on a busy machine each takes longer
        latest = began + MAX_SETTLING * self._settling_time
        while quiet < self._settling_time / POLL_GRAPH or (
            time.monotonic() < latest and self._is_incomplete()
        ):
            rclpy.spin_once(self._node, timeout_sec=POLL_GRAPH)
            found = self._node.get_node_names_and_namespaces(), self._node.get_topic_names_and_types()
            quiet, known = (quiet + 1 if found == known else 0), found

    def _is_incomplete(self) -> bool:
        """Return whether there is a participant whose nodes, or a node whose endpoints, are not known yet."""
        nodes = self._node.get_node_names_and_namespaces()
        if len(nodes) == 1:  # its own node
            return len(domains.participant_ports(self.domain)) > 2
        return not all(_endpoints_of(self._node.get_publisher_names_and_types_by_node, *of) for of in nodes)

    @property
    def nodes(self) -> list[str]:
        """Work like `System`."""
        found = self._node.get_node_names_and_namespaces()
        return [f"{space.rstrip('/')}/{name}" for name, space in found if name != self._node.get_name()]

    @property
    def endpoints(self) -> list[Endpoint]:
        """Work like `System`, with the QoS of topics as far as the middleware knows it."""
        own_name = self._node.get_fully_qualified_name()
        return [endpoint for endpoint in endpoints_seen_by(self._node) if endpoint.node != own_name]

    @property
    def now(self) -> float:
        """Work like `System`: of the wall clock."""
        return time.time()

    def look_up(self, name: str, find: Callable[[], Known], seconds: float | None = None) -> Known:
        """Work like `System`."""
        found = find()
        for _ in range(MAX_RETRIES if seconds is None else round(seconds / POLL_GRAPH)):
            if name in found:
                break
            rclpy.spin_once(self._node, timeout_sec=POLL_GRAPH)
            found = find()
        return found

    def subscribe(
        self, topics: dict[str, str], profile: QoSProfile | None = None
    ) -> Iterator[ReceivedMessage | None]:
        """Work like `System`, until Ctrl-C."""
        received: list[ReceivedMessage] = []

        def make_callback(topic: str, type_: str) -> Callable[..., None]:
            def on_message(raw: bytes, info: dict[str, Any]) -> None:
                received.append(ReceivedMessage(self.now, info["source_timestamp"] * 1e-9, topic, type_, raw))

            return on_message

        subscriptions = []
        for topic, type_ in topics.items():
            chosen = self._profile(topic) if profile is None else profile
            kind, callback = message_class(type_), make_callback(topic, type_)
            subscriptions.append(self._node.create_subscription(kind, topic, callback, chosen, raw=True))
        try:
            while True:
                rclpy.spin_once(self._node, timeout_sec=POLL)
                yield from received
                received.clear()
                yield None
        finally:
            for subscription in subscriptions:
                self._node.destroy_subscription(subscription)

    def uninterrupted(self) -> AbstractContextManager[Sequence[int]]:
        """Work like `System`."""
        return uninterrupted()

    def _profile(self, topic: str) -> QoSProfile:
        """The strongest QoS that matches all publishers of a topic."""
        offered = [_endpoint(topic, end).qos for end in self._node.get_publishers_info_by_topic(topic)]
        chosen = QoSProfile(depth=qos_profile_sensor_data.depth)
        for policy in ("reliability", "durability"):
            values = {offer[policy] for offer in offered}
            default = {"reliability": "best_effort", "durability": "volatile"}[policy]
            kind = type(getattr(chosen, policy))
            setattr(chosen, policy, kind[(values.pop() if len(values) == 1 else default).upper()])
        return chosen

    def run_with_node(self, task: NodeTask[T], seconds: float | None = None) -> T:
        """Work like `System`, without a time limit: Ctrl-C ends it."""
        return with_node(task, Output(self.print_line))


def endpoints_seen_by(node: Node) -> list[Endpoint]:
    """All endpoints of topics, services and actions that a node has discovered, including its own."""
    found = []
    for topic, _ in node.get_topic_names_and_types():
        for end in node.get_publishers_info_by_topic(topic) + node.get_subscriptions_info_by_topic(topic):
            found.append(_endpoint(topic, end))
    queries = {
        "service": node.get_service_names_and_types_by_node,
        "client": node.get_client_names_and_types_by_node,
        # As rclpy.action does: that package imports numpy, which takes a while.
        "action server": node.handle.get_action_server_names_and_types_by_node,
        "action client": node.handle.get_action_client_names_and_types_by_node,
    }
    for name, space in dict.fromkeys(node.get_node_names_and_namespaces()):
        full = f"{space.rstrip('/')}/{name}"
        for kind, query in queries.items():
            endpoints = _endpoints_of(query, name, space)
            found += [Endpoint(kind, full, end, type_, {}) for end, types in endpoints for type_ in types]
    return found


def _endpoints_of(query: Callable[..., _Ends], name: str, space: str) -> _Ends:
    """A node's endpoints by one of rclpy's queries; none if the node has exited meanwhile."""
    try:
        return query(name, space)
    except NodeNameNonExistentError:
        return []


def _endpoint(topic: str, end: Any) -> Endpoint:
    """The endpoint that the middleware's information describes."""
    full = f"{end.node_namespace.rstrip('/')}/{end.node_name}"
    qos = settings(end.qos_profile) | {"gid": ".".join(f"{byte:02x}" for byte in end.endpoint_gid)}
    return Endpoint(end.endpoint_type.name.lower(), full, topic, end.topic_type, qos)
