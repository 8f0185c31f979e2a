"""Eight nodes that publish on topics of their own, and one that asks who publishes where."""

import functools
import itertools
import random
from collections.abc import Callable
from typing import NamedTuple

from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import String

TOPICS = "/scan", "/map", "/battery", "/speech", "/goal", "/arm/state", "/camera/image", "/tool"
NAMES = "lidar", "planner", "camera", "pilot", "arm", "speaker", "charger", "helper", "scout", "watcher"
SPACES = "", "", "/robot1", "/kitchen", "/dock"
BEGIN, LATE = 0.05, 3.25  # s; between two questions
PERIOD, PAUSE = 0.2, 0.5  # s between two messages, and between two questions


class SpeakerPlan(NamedTuple):
    """One of the eight nodes."""

    name: str
    space: str
    publishes: tuple[str, ...]  # a topic that is named twice has two publishers
    subscribes: tuple[str, ...]
    begin: float  # s


def plans(seed: int) -> tuple[list[SpeakerPlan], list[str]]:
    """Return the nodes of a seed, and the topics of the questions, in their order.

    One topic has one publishing node; one has three, of which one joins late; one has only subscribers; one
    has two publishing nodes, of which one has two publishers.
    """
    draw = random.Random(f"crowd {seed}")
    topics, names = draw.sample(TOPICS, 4), draw.sample(NAMES, 8)
    one, many, none, twice = topics
    speaks = [(one,), (many,), (many, twice), (many,), (twice, twice), (), (), ()]
    listens = [(many,), (none,), (one,), (), (one, many), (one, twice), (none, many), (many, one)]
    spaces = [draw.choice(SPACES) for _ in names]
    spaces[1], spaces[4] = "/robot1", "/kitchen"  # so that a bare name is never enough
    begins = [LATE if index == 3 else BEGIN for index in range(len(names))]
    nodes = [SpeakerPlan(*row) for row in zip(names, spaces, speaks, listens, begins, strict=True)]
    draw.shuffle(nodes)
    return nodes, draw.sample(topics, len(topics))


class Speaker(Node):
    """Publishes its name (String) on each of its topics at 5 Hz, from its beginning on."""

    def __init__(self, member: SpeakerPlan) -> None:
        super().__init__(member.name, namespace=member.space or None)
        self.member = member
        self.outlets: list[Publisher] = []
        for topic in member.subscribes:
            self.create_subscription(String, topic, lambda msg: None, 10)
        self.begin = self.create_timer(member.begin, self.join)
        self.create_timer(PERIOD, self.speak)

    def join(self) -> None:
        """Create the publishers."""
        self.begin.cancel()
        self.outlets = [self.create_publisher(String, topic, 10) for topic in self.member.publishes]

    def speak(self) -> None:
        """Publish on each topic."""
        for outlet in self.outlets:
            outlet.publish(String(data=self.get_name()))


class QuestionPublisher(Node):
    """Asks on /question (String) who publishes on a topic, at 2 Hz from 1 s on, one topic after another."""

    def __init__(self, topics: list[str]) -> None:
        super().__init__("asker")
        self.publisher = self.create_publisher(String, "/question", 10)
        self.topics, self.ticks = itertools.cycle(topics), 0
        self.create_timer(PAUSE, self.publish_question)

    def publish_question(self) -> None:
        """Ask about the next topic."""
        self.ticks += 1
        if self.ticks > 1:
            self.publisher.publish(String(data=next(self.topics)))


def speakers(seed: int) -> list[Callable[[], Node]]:
    """Return the nodes of a seed and the one with the questions, as companions of a run."""
    nodes, topics = plans(seed)
    return [
        functools.partial(QuestionPublisher, topics),
        *(functools.partial(Speaker, member) for member in nodes),
    ]
