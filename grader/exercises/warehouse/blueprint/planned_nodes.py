"""Programs that have the publishers and subscriptions of a plan, and publish empty messages."""

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Image


class PlannedEndpoint(NamedTuple):
    """A line of a plan. kind: "subscription" or "publisher"."""

    kind: str
    topic: str
    type: Any
    profile: QoSProfile | int


def subscribes(topic: str, type: Any, profile: QoSProfile | int = 10) -> PlannedEndpoint:
    """A line of a plan: this program subscribes to a topic."""
    return PlannedEndpoint("subscription", topic, type, profile)


def publishes(topic: str, type: Any, profile: QoSProfile | int = 10) -> PlannedEndpoint:
    """A line of a plan: this program publishes on a topic."""
    return PlannedEndpoint("publisher", topic, type, profile)


def sketch(plan: Mapping[str, Callable[[], Sequence[PlannedEndpoint]]]) -> Callable[[], None]:
    """Return a program with a node for each name of the plan, with what the function of that name lists.

    The nodes publish empty messages, five times a second.
    """

    def main() -> None:
        rclpy.init()
        executor = SingleThreadedExecutor()
        for name, lines in plan.items():
            executor.add_node(_node(name, lines()))
        executor.spin()

    return main


def _node(name: str, ends: Sequence[PlannedEndpoint]) -> Node:
    node = Node(name)
    for end in ends:
        if end.kind == "subscription":
            node.create_subscription(end.type, end.topic, lambda message: None, end.profile)
        else:
            publisher = node.create_publisher(end.type, end.topic, end.profile)
            node.create_timer(0.2, functools.partial(publisher.publish, end.type()))
    return node


class ShelfCamera(Node):
    """The camera of the robot: a small picture on /image, five times a second."""

    def __init__(self) -> None:
        super().__init__("camera")
        self.publisher = self.create_publisher(Image, "/image", qos_profile_sensor_data)
        self.picture = Image(height=2, width=2, encoding="mono8", step=2, data=[0, 255, 255, 0])
        self.create_timer(0.2, lambda: self.publisher.publish(self.picture))
