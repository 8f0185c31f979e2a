"""A graph on paper, and the programs that have its ends, and only empty messages to say."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Image

from sim.world import World


class Ear(NamedTuple):
    """A subscription to be: to which topic, of which type, with which profile."""

    topic: str
    type: Any
    profile: QoSProfile | int


class Mouth(NamedTuple):
    """A publisher to be."""

    topic: str
    type: Any
    profile: QoSProfile | int


def hears(topic: str, type: Any, profile: QoSProfile | int = 10) -> Ear:
    """A line of a plan: this program subscribes to a topic."""
    return Ear(topic, type, profile)


def says(topic: str, type: Any, profile: QoSProfile | int = 10) -> Mouth:
    """A line of a plan: this program publishes on a topic."""
    return Mouth(topic, type, profile)


def sketch(plan: Mapping[str, Callable[[], Sequence[Ear | Mouth]]]) -> Callable[[], None]:
    """A program with a node for each name of the plan, and its ends: what the function of that name lists.

    The nodes publish empty messages, five times a second.
    """

    def main() -> None:
        rclpy.init()
        executor = SingleThreadedExecutor()
        for name, lines in plan.items():
            executor.add_node(_node(name, lines()))
        executor.spin()

    return main


def _node(name: str, ends: Sequence[Ear | Mouth]) -> Node:
    node = Node(name)
    for end in ends:
        if isinstance(end, Ear):
            node.create_subscription(end.type, end.topic, lambda message: None, end.profile)
        else:
            publisher = node.create_publisher(end.type, end.topic, end.profile)
            node.create_timer(0.2, functools.partial(publisher.publish, end.type()))
    return node


class Camera(Node):
    """The camera of the robot: a small picture on /image, five times a second."""

    def __init__(self) -> None:
        super().__init__("camera")
        self.publisher = self.create_publisher(Image, "/image", qos_profile_sensor_data)
        self.picture = Image(height=2, width=2, encoding="mono8", step=2, data=[0, 255, 255, 0])
        self.create_timer(0.2, lambda: self.publisher.publish(self.picture))


def hall(seed: int) -> World:
    """The warehouse for which the plan is."""
    return World.generate("warehouse", seed=seed)
