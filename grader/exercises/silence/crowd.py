"""Nodes of ours for the first exercise: a crowd that talks on topics of its own, and somebody who asks."""

from __future__ import annotations

import functools
import itertools
import random
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from std_msgs.msg import String

TOPICS = "/scan", "/map", "/battery", "/speech", "/goal", "/arm/state", "/camera/image", "/tool"
NAMES = "lidar", "planner", "camera", "pilot", "arm", "speaker", "charger", "helper", "scout", "watcher"
SPACES = "", "", "/robot1", "/kitchen", "/dock"
BEGIN, LATE = 0.05, 3.25  # s; between two questions
PERIOD, PAUSE = 0.2, 0.5  # s between two messages, and between two questions


class Member(NamedTuple):
    """One node of the crowd."""

    name: str
    space: str
    speaks: tuple[str, ...]  # a topic that is named twice has two publishers
    listens: tuple[str, ...]
    begin: float  # s


def members(seed: int) -> tuple[list[Member], list[str]]:
    """A crowd drawn from a seed, and the topics that are asked about, in this order.

    One topic has one speaker; one has three, of whom one joins late; on one nobody speaks, though two listen;
    on one two speak, one of them by two publishers.
    """
    draw = random.Random(f"crowd {seed}")
    topics, names = draw.sample(TOPICS, 4), draw.sample(NAMES, 8)
    one, many, none, twice = topics
    speaks = [(one,), (many,), (many, twice), (many,), (twice, twice), (), (), ()]
    listens = [(many,), (none,), (one,), (), (one, many), (one, twice), (none, many), (many, one)]
    spaces = [draw.choice(SPACES) for _ in names]
    spaces[1], spaces[4] = "/robot1", "/kitchen"  # so that a bare name is never enough
    begins = [LATE if index == 3 else BEGIN for index in range(len(names))]
    crowd = [Member(*row) for row in zip(names, spaces, speaks, listens, begins, strict=True)]
    draw.shuffle(crowd)
    return crowd, draw.sample(topics, len(topics))


class Speaker(Node):
    """Says its name (String) on each of its topics, five times a second, from its beginning on."""

    def __init__(self, member: Member) -> None:
        super().__init__(member.name, namespace=member.space or None)
        self.member, self.outlets = member, []
        for topic in member.listens:
            self.create_subscription(String, topic, lambda msg: None, 10)
        self.begin = self.create_timer(member.begin, self.join)
        self.create_timer(PERIOD, self.speak)

    def join(self) -> None:
        """Make the publishers."""
        self.begin.cancel()
        self.outlets = [self.create_publisher(String, topic, 10) for topic in self.member.speaks]

    def speak(self) -> None:
        """Say something on each topic."""
        for outlet in self.outlets:
            outlet.publish(String(data=self.get_name()))


class Asker(Node):
    """Asks on /question (String) who publishes on a topic, twice a second, from 1 s on: one after another."""

    def __init__(self, topics: list[str]) -> None:
        super().__init__("asker")
        self.publisher = self.create_publisher(String, "/question", 10)
        self.topics, self.ticks = itertools.cycle(topics), 0
        self.create_timer(PAUSE, self.ask)

    def ask(self) -> None:
        """Ask about the next topic."""
        self.ticks += 1
        if self.ticks > 1:
            self.publisher.publish(String(data=next(self.topics)))


def crowd(seed: int) -> list[Callable[[], Node]]:
    """The crowd of a seed and the one who asks, as companions of a run."""
    people, topics = members(seed)
    return [functools.partial(Asker, topics), *(functools.partial(Speaker, member) for member in people)]
