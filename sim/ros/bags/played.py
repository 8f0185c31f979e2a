"""A bag as the world of a run: its messages are published at the times at which they were recorded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import rclpy
import yaml
from rclpy.clock_type import ClockType
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.time import Time

from sim.evidence.rows import INFRASTRUCTURE_TOPICS
from sim.nanoseconds import EPOCH, SECOND, Nanoseconds
from sim.ros.bags.bag_error import BagError
from sim.ros.bags.bag_files import Bag
from sim.ros.bags.qos import offered_profile
from sim.ros.bags.sqlite import QOS
from sim.ros.engine.program import Process
from sim.ros.messages.codec import message_class

NAME = "rosbag2_player"
DISCOVERY: Nanoseconds = SECOND // 1000  # until subscriptions that are made at the start get messages
LONGEST_RUN: Nanoseconds = 1_000_000 * SECOND
AFTER = 1.0  # s that a run lasts after the last message


class BagMessage(NamedTuple):
    """A message of a bag. moment: when it was recorded, in nanoseconds since 1970."""

    moment: Nanoseconds
    topic: str
    type: str
    raw: bytes


@dataclass(frozen=True)
class PlayedBag:
    """A bag that is read, to be played.

    messages: in the order of their recording. qos: by topic, as bags store it. left_out: why topics are not
    played, by topic.
    """

    messages: Sequence[BagMessage]
    qos: dict[str, Any]
    left_out: dict[str, str]

    @classmethod
    def read(cls, path: str | Path) -> PlayedBag:
        """Read a bag. Raises BagError if it is none, or has no message that can be played."""
        bag = Bag(Path(path))
        stored = metadata_qos(bag.path)
        messages, qos, left_out = [], {}, {}
        for schema, channel, message in bag.messages():
            topic = channel.topic
            if topic in INFRASTRUCTURE_TOPICS or topic in left_out:
                continue
            if topic not in qos:
                if not is_installed(schema.name):
                    left_out[topic] = f"{schema.name} is not installed"
                    continue
                qos[topic] = channel.metadata.get(QOS) or stored.get(topic, "")
            messages.append(BagMessage(message.log_time, topic, schema.name, message.data))
        if not messages:
            reasons = "; ".join(f"{topic}: {reason}" for topic, reason in left_out.items()) or "it is empty"
            raise BagError(f"Bag {path} has no message that can be played ({reasons}).")
        return cls(sorted(messages, key=lambda item: item.moment), qos, left_out)

    @property
    def epoch(self) -> Nanoseconds:
        """The time that clocks show at the start of the run: that of the first message.

        A bag that was recorded in a run keeps the time of that run.
        """
        begin = self.messages[0].moment
        return EPOCH if EPOCH <= begin < EPOCH + LONGEST_RUN else begin

    @property
    def seconds(self) -> float:
        """The length of a run that plays all of it."""
        return (self.messages[-1].moment - self.epoch) / SECOND + AFTER

    def program(self) -> Process:
        """The program that publishes the messages, as a companion of a run."""

        def rosbag2_player() -> None:
            play_messages(self)

        return Process(rosbag2_player)


def play_messages(bag: PlayedBag) -> None:
    """Publish the messages when they are due by the clock, and then wait for the end of the run."""
    rclpy.init()
    node = Node(NAME, start_parameter_services=False)
    try:
        publishers = {}
        for _, topic, type_, _ in bag.messages:
            if topic not in publishers:
                profile = offered_profile(bag.qos[topic])
                publishers[topic] = node.create_publisher(message_class(type_), topic, profile)
        for topic, reason in bag.left_out.items():
            node.get_logger().warning(f"Not played: {topic}, because {reason}")
        clock = node.get_clock()
        first = clock.now().nanoseconds + DISCOVERY
        for moment, topic, _, raw in bag.messages:
            clock.sleep_until(Time(nanoseconds=max(moment, first), clock_type=ClockType.ROS_TIME))
            publishers[topic].publish(raw)
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


def is_installed(type_: str) -> bool:
    """Return whether messages of this type can be published here."""
    try:
        message_class(type_)
    except (ImportError, AttributeError, ValueError):
        return False
    return True


def metadata_qos(path: Path) -> dict[str, Any]:
    """The QoS by topic in a bag's metadata.yaml; empty without such a file."""
    try:
        data = yaml.safe_load((path / "metadata.yaml").read_text(encoding="utf-8"))
        topics = data["rosbag2_bagfile_information"]["topics_with_message_count"]
        found = [topic["topic_metadata"] for topic in topics]
        return {each["name"]: each.get("offered_qos_profiles") or "" for each in found}
    except (OSError, ValueError, yaml.YAMLError, KeyError, TypeError, AttributeError):
        return {}
