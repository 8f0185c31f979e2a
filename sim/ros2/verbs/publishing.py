"""ros2 topic pub: publish messages."""

from __future__ import annotations

import math
from argparse import ArgumentTypeError, Namespace
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSPresetProfiles

from sim.ros2.group import argument, flag
from sim.ros2.qos_words import QOS, asked_profile
from sim.ros2.system import POLL, System, Voice, Wrong
from sim.ros2.text import fill, read_values
from sim.ros2.types import type_of
from sim.ros2.verbs.topic import NAME, topic, types_of
from sim.suggestions import closest_match

ROUND_OFF = 1.0  # s more than a play should take


def positive_number(word: str) -> float:
    """A number above 0, for an option."""
    try:
        number = float(word)
    except ValueError:
        raise ArgumentTypeError("Expects a floating point number") from None
    if not 0 < number < math.inf:
        raise ArgumentTypeError("Value must be positive")
    return number


@topic.verb(
    "pub",
    NAME,
    argument("message_type", help="Type of the ROS message (e.g. 'std_msgs/msg/String')", offers=types_of),
    argument("values", nargs="?", default="{}", help="Values in YAML (e.g. '{data: Hello World}')"),
    argument("-r", "--rate", type=positive_number, default=1.0, metavar="N", help="Hz (default: 1)"),
    argument("-p", "--print", type=int, default=1, metavar="N", help="Only print every N-th message"),
    flag("-1", "--once", help="Publish one message and exit"),
    argument("-t", "--times", type=int, default=0, help="Publish this number of times and then exit"),
    argument("-w", "--wait-matching-subscriptions", type=int, help="Wait for so many; with -1 or -t for 1"),
    argument("--max-wait-time-secs", type=positive_number, help="Wait so long for them at most"),
    argument("--keep-alive", type=positive_number, default=0.1, metavar="N", help="Stay so long after it"),
    argument("-n", "--node-name", help="Name of the created publishing node"),
    *QOS,
)
def pub(system: System, asked: Namespace) -> None:
    """Publish a message to a topic."""
    kind = type_of(asked.message_type, "msg", "The passed message type is invalid")
    values = read_values(asked.values)
    if not isinstance(values, dict):
        raise Wrong("The passed value needs to be a dictionary in YAML format")
    times = 1 if asked.once else asked.times
    if not times and system.window is not None:
        times = max(round(system.window * asked.rate), 1)
    asked.times, seconds = times, None
    if times:
        seconds = ROUND_OFF + times / asked.rate + asked.keep_alive + (asked.max_wait_time_secs or 0.0)
    system.act(lambda node, voice: _publish(node, voice, kind, values, asked), seconds)


def _publish(node: Node, voice: Voice, kind: type, values: Any, asked: Namespace) -> None:
    profile = asked_profile(asked, "default") or QoSPresetProfiles.get_from_short_key("default")
    if asked.node_name:
        node = rclpy.create_node(asked.node_name)
    publisher = node.create_publisher(kind, asked.topic_name, profile)
    _wait(node, voice, publisher, asked)
    if voice.stopped:
        return
    message = kind()
    setters = fill(message, values)
    voice.say("publisher: beginning loop")
    count = 0

    def publish() -> None:
        nonlocal count
        for set_stamp in setters:
            set_stamp(node.get_clock().now().to_msg())
        count += 1
        if asked.print and count % asked.print == 0:
            voice.say(f"publishing #{count}: {message!r}\n")
        publisher.publish(message)

    publish()
    timer = node.create_timer(1 / asked.rate, publish)
    while not voice.stopped and (not asked.times or count < asked.times):
        rclpy.spin_once(node, timeout_sec=POLL)
    timer.cancel()
    node.get_clock().sleep_for(rclpy.duration.Duration(seconds=asked.keep_alive))
    if asked.node_name:
        node.destroy_node()


def _wait(node: Node, voice: Voice, publisher: Any, asked: Namespace) -> None:
    """Wait until so many hear it. Raises Wrong where they don't come."""
    wanted = asked.wait_matching_subscriptions
    wanted = int(asked.times != 0) if wanted is None else wanted
    waited = 0
    while (there := publisher.get_subscription_count()) < wanted and not voice.stopped:
        if waited % 10 == 0:
            near = "" if waited else _near_topic(node, publisher.topic_name)
            voice.say(f"Waiting for at least {wanted} matching subscription(s)...{near}")
        if asked.max_wait_time_secs is not None and waited * POLL >= asked.max_wait_time_secs:
            raise Wrong(
                f"Timed out waiting for subscribers: Expected {wanted} subcribers but only got {there}"
                " subscribers"
            )
        waited += 1
        rclpy.spin_once(node, timeout_sec=POLL)


def _near_topic(node: Node, name: str) -> str:
    known = [topic for topic, _ in node.get_topic_names_and_types() if topic != name]
    near = closest_match(name, known)
    lonely = near and not node.count_subscribers(name)
    return f" Nobody listens on {name}. Did you mean {near}?" if lonely else ""
