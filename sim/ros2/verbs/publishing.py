"""ros2 topic pub: publish messages."""

from __future__ import annotations

import math
from argparse import ArgumentTypeError, Namespace
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSPresetProfiles

from sim.ros2.group import argument, flag
from sim.ros2.interface_types import type_class
from sim.ros2.qos_options import QOS, profile_from_options
from sim.ros2.system import POLL, CliError, Output, System
from sim.ros2.text import fill, read_values
from sim.ros2.verbs import echo as _echo  # noqa: F401  (its verbs come before `pub`)
from sim.ros2.verbs.topic import NAME, topic, types_of
from sim.suggestions import closest_match

MARGIN = 1.0  # s beyond the expected duration of a task


def positive_float(text: str) -> float:
    """The value of an option that must be a positive number."""
    try:
        number = float(text)
    except ValueError:
        raise ArgumentTypeError("Expects a floating point number") from None
    if not 0 < number < math.inf:
        raise ArgumentTypeError("Value must be positive")
    return number


@topic.verb(
    "pub",
    NAME,
    argument("message_type", help="Type of the ROS message (e.g. 'std_msgs/msg/String')", completer=types_of),
    argument("values", nargs="?", default="{}", help="Values in YAML (e.g. '{data: Hello World}')"),
    argument("-r", "--rate", type=positive_float, default=1.0, metavar="N", help="Hz (default: 1)"),
    argument("-p", "--print", type=int, default=1, metavar="N", help="Only print every N-th message"),
    flag("-1", "--once", help="Publish one message and exit"),
    argument("-t", "--times", type=int, default=0, help="Publish this number of times and then exit"),
    argument("-w", "--wait-matching-subscriptions", type=int, help="Wait for so many; with -1 or -t for 1"),
    argument("--max-wait-time-secs", type=positive_float, help="Wait so long for them at most"),
    argument("--keep-alive", type=positive_float, default=0.1, metavar="N", help="Stay so long after it"),
    argument("-n", "--node-name", help="Name of the created publishing node"),
    *QOS,
)
def pub(system: System, options: Namespace) -> None:
    """Publish a message to a topic."""
    kind = type_class(options.message_type, "msg", "The passed message type is invalid")
    values = read_values(options.values)
    if not isinstance(values, dict):
        raise CliError("The passed value needs to be a dictionary in YAML format")
    times = 1 if options.once else options.times
    if options.wait_matching_subscriptions is None:
        options.wait_matching_subscriptions = int(times != 0)
    if not times and system.time_limit is not None:
        times = max(round(system.time_limit * options.rate), 1)
    options.times, seconds = times, None
    if times:
        seconds = MARGIN + times / options.rate + options.keep_alive + (options.max_wait_time_secs or 0.0)
    system.run_with_node(lambda node, output: _publish(node, output, kind, values, options), seconds)


def _publish(node: Node, output: Output, kind: type, values: Any, options: Namespace) -> None:
    profile = profile_from_options(options, "default") or QoSPresetProfiles.get_from_short_key("default")
    if options.node_name:
        node = rclpy.create_node(options.node_name)
    publisher = node.create_publisher(kind, options.topic_name, profile)
    _wait_for_subscriptions(node, output, publisher, options)
    if output.canceled:
        return
    message = kind()
    setters = fill(message, values)
    output.print_line("publisher: beginning loop")
    count = 0

    def publish() -> None:
        nonlocal count
        for set_stamp in setters:
            set_stamp(node.get_clock().now().to_msg())
        count += 1
        if options.print and count % options.print == 0:
            output.print_line(f"publishing #{count}: {message!r}\n")
        publisher.publish(message)

    publish()
    timer = node.create_timer(1 / options.rate, publish)
    while not output.canceled and (not options.times or count < options.times):
        rclpy.spin_once(node, timeout_sec=POLL)
    timer.cancel()
    node.get_clock().sleep_for(rclpy.duration.Duration(seconds=options.keep_alive))
    if options.node_name:
        node.destroy_node()


def _wait_for_subscriptions(node: Node, output: Output, publisher: Any, options: Namespace) -> None:
    """Wait for matching subscriptions. Raises CliError if there are too few in time."""
    minimum, waited = options.wait_matching_subscriptions, 0
    while (count := publisher.get_subscription_count()) < minimum and not output.canceled:
        if waited % 10 == 0:
            near = "" if waited else _near_topic(node, publisher.topic_name)
            output.print_line(f"Waiting for at least {minimum} matching subscription(s)...{near}")
        if options.max_wait_time_secs is not None and waited * POLL >= options.max_wait_time_secs:
            raise CliError(
                f"Timed out waiting for subscribers: Expected {minimum} subcribers but only got {count}"
                " subscribers"
            )
        waited += 1
        rclpy.spin_once(node, timeout_sec=POLL)


def _near_topic(node: Node, name: str) -> str:
    known = [topic for topic, _ in node.get_topic_names_and_types() if topic != name]
    near = closest_match(name, known)
    unmatched = near and not node.count_subscribers(name)
    return f" No node subscribes to {name}. Did you mean {near}?" if unmatched else ""
