"""The words of ros2 about nodes in other processes on this machine, in real time."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from typing import Any

import rclpy
import rclpy.action
from rclpy.node import Node, NodeNameNonExistentError
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from rclpy.signals import SignalHandlerOptions

from sim import ros_environment
from sim.evidence import Endpoint
from sim.evidence.qos import settings
from sim.ros.messages.codec import message_class
from sim.ros2 import domains
from sim.ros2.system import POLL, Arrived, Known, System, T, Voice, Work, with_node

SETTLED = 0.5  # s without news, as the official tools wait
LOOK = 0.05  # s, between two looks at it
AGAIN = 30  # looks for a name that isn't there yet: another process may be slow
PATIENCE = 10  # times as long, while somebody is there of whom nothing is known yet


class Live(System):
    """The nodes of one ROS domain; a context manager.

    say: shows a line. complain: shows a note that is no part of the answer. settled: seconds without news
    until the graph is taken for known.
    """

    def __init__(
        self,
        say: Callable[[str], None] = print,
        complain: Callable[[str], None] = lambda _: None,
        settled: float = SETTLED,
    ) -> None:
        super().__init__(say)
        self._complain, self._settled = complain, settled

    def __enter__(self) -> Live:
        self.domain = domains.chosen()
        ros_environment.open_to_this_machine(self.domain)
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        self._node = rclpy.create_node(
            f"_ros2cli_{os.getpid()}", start_parameter_services=False, enable_rosout=False
        )
        self._find_others()
        return self

    def __exit__(self, *exception: object) -> None:
        self._node.destroy_node()
        rclpy.try_shutdown()

    def _find_others(self) -> None:
        """Wait until no more nodes are found. Where nobody is there say so, for silence says little."""
        began = time.monotonic()
        known: Any = None
        quiet = 0  # looks without news; on a busy machine each takes longer
        last = began + PATIENCE * self._settled
        while quiet < self._settled / LOOK or (time.monotonic() < last and self._more_to_come()):
            rclpy.spin_once(self._node, timeout_sec=LOOK)
            found = self._node.get_node_names_and_namespaces(), self._node.get_topic_names_and_types()
            quiet, known = (quiet + 1 if found == known else 0), found
        if not self.nodes and (note := domains.note(self.domain)):
            self._complain(note)

    def _more_to_come(self) -> bool:
        """Whether a process with sockets of this domain, or a node, is there of which nothing is known."""
        nodes = self._node.get_node_names_and_namespaces()
        if len(nodes) == 1:  # the own one
            return len(domains.ports(self.domain)) > 2
        return not all(_ends_of(self._node.get_publisher_names_and_types_by_node, *of) for of in nodes)

    @property
    def nodes(self) -> list[str]:
        """As `System`."""
        found = self._node.get_node_names_and_namespaces()
        return [f"{space.rstrip('/')}/{name}" for name, space in found if name != self._node.get_name()]

    @property
    def ends(self) -> list[Endpoint]:
        """As `System`. Of topics with the settings of each, as far as the middleware tells them."""
        own = self._node.get_fully_qualified_name()
        return [end for end in ends_seen_by(self._node) if end.node != own]

    @property
    def now(self) -> float:
        """As `System`: of the wall clock."""
        return time.time()

    def look_for(self, name: str, look: Callable[[], Known]) -> Known:
        """As `System`."""
        found = look()
        for _ in range(AGAIN):
            if name in found:
                break
            rclpy.spin_once(self._node, timeout_sec=LOOK)
            found = look()
        return found

    def listen(self, topics: dict[str, str], profile: QoSProfile | None = None) -> Iterator[Arrived | None]:
        """As `System`, until Ctrl-C."""
        come: list[Arrived] = []

        def hear(topic: str, type_: str) -> Callable[[bytes, dict], None]:
            def hear(raw: bytes, info: dict) -> None:
                come.append(Arrived(self.now, info["source_timestamp"] * 1e-9, topic, type_, raw))

            return hear

        made = []
        for topic, type_ in topics.items():
            chosen = self._profile(topic) if profile is None else profile
            kind, callback = message_class(type_), hear(topic, type_)
            made.append(self._node.create_subscription(kind, topic, callback, chosen, raw=True))
        try:
            while True:
                rclpy.spin_once(self._node, timeout_sec=POLL)
                yield from come
                come.clear()
                yield None
        finally:
            for subscription in made:
                self._node.destroy_subscription(subscription)

    def _profile(self, topic: str) -> QoSProfile:
        """The strongest settings that hear all publishers of a topic."""
        offered = [_endpoint(topic, end).qos for end in self._node.get_publishers_info_by_topic(topic)]
        chosen = QoSProfile(depth=qos_profile_sensor_data.depth)
        for policy in ("reliability", "durability"):
            words = {offer[policy] for offer in offered}
            default = {"reliability": "best_effort", "durability": "volatile"}[policy]
            kind = type(getattr(chosen, policy))
            setattr(chosen, policy, kind[(words.pop() if len(words) == 1 else default).upper()])
        return chosen

    def act(self, work: Work[T], seconds: float | None = None) -> T:
        """As `System`; Ctrl-C ends what takes long."""
        return with_node(work, Voice(self.say))


def ends_seen_by(node: Node) -> list[Endpoint]:
    """All ends of topics, services and actions in a node's domain that it knows by now, its own included."""
    found = []
    for topic, _ in node.get_topic_names_and_types():
        for end in node.get_publishers_info_by_topic(topic) + node.get_subscriptions_info_by_topic(topic):
            found.append(_endpoint(topic, end))
    asked = {
        "service": node.get_service_names_and_types_by_node,
        "client": node.get_client_names_and_types_by_node,
        "action server": lambda *of: rclpy.action.get_action_server_names_and_types_by_node(node, *of),
        "action client": lambda *of: rclpy.action.get_action_client_names_and_types_by_node(node, *of),
    }
    for name, space in dict.fromkeys(node.get_node_names_and_namespaces()):
        full = f"{space.rstrip('/')}/{name}"
        for kind, ask in asked.items():
            ends = _ends_of(ask, name, space)
            found += [Endpoint(kind, full, end, type_, {}) for end, types in ends for type_ in types]
    return found


def _ends_of(ask: Callable[..., list], name: str, space: str) -> list:
    """What rclpy tells of a node's ends; nothing where it has gone since."""
    try:
        return ask(name, space)
    except NodeNameNonExistentError:
        return []


def _endpoint(topic: str, end: Any) -> Endpoint:
    """What the middleware says of one end of a topic."""
    full = f"{end.node_namespace.rstrip('/')}/{end.node_name}"
    qos = settings(end.qos_profile) | {"gid": ".".join(f"{byte:02x}" for byte in end.endpoint_gid)}
    return Endpoint(end.endpoint_type.name.lower(), full, topic, end.topic_type, qos)
