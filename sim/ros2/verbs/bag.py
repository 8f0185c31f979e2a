"""ros2 bag: record messages, print information about a bag, and play it back."""

from __future__ import annotations

import time
from argparse import Namespace
from pathlib import Path
from typing import Any

import rclpy
import yaml
from mcap.records import Channel
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from sim.nanoseconds import SECOND
from sim.ros.messages.codec import message_class
from sim.ros2.bags import DURABILITIES, QOS, RELIABILITIES, Bag, BagWriter
from sim.ros2.group import Group, argument, flag
from sim.ros2.interface_types import installed_type
from sim.ros2.system import CliError, Output, System, suggestion
from sim.ros2.verbs.publishing import MARGIN, positive_float

bag = Group("bag", "Bags: record messages, look at them, publish them again")
PATH = argument("bag_path", type=Path, help="The folder of a bag, or an .mcap file")


@bag.verb(
    "record",
    argument("topics_positional", nargs="*", metavar="TOPIC", help="Topics to record"),
    argument("--topics", nargs="+", default=[], metavar="TOPIC", help="Topics to record"),
    flag("-a", "--all", help="Record all topics"),
    argument("-o", "--output", type=Path, help="The folder to make; by default it is named by the time"),
)
def record(system: System, options: Namespace) -> None:
    """Record ROS data to a bag."""
    requested = [*options.topics, *options.topics_positional]
    if not requested and not options.all:
        raise CliError("Need to specify at least one option out of --all, --topics")
    known = system.topics()
    for name in requested:
        if name not in known:
            system.print_line(
                f"WARNING: topic [{name}] does not appear to be published yet{suggestion(name, known)}"
            )
    for _ in system.subscribe({}) if system.time_limit is None and not system.finished else ():
        known = system.topics()
        if known.keys() >= set(requested):
            break
    chosen = {
        name: installed_type(types[0]) for name, types in known.items() if options.all or name in requested
    }
    if not chosen:
        raise CliError("There is nothing to record.")
    qos = {end.name: end.qos for end in system.endpoints if end.kind == "publisher"}
    folder = options.output or Path(time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    with BagWriter(folder, system.epoch) as writer:
        for name in chosen:
            system.print_line(f"Subscribed to topic '{name}'")
        try:
            for message in system.subscribe(chosen):
                if message is not None:
                    writer.write(message, qos.get(message.topic, {}))
        finally:
            system.print_line(f"Recording stopped: {writer.counts.total()} messages in {folder}")


@bag.verb("info", PATH, flag("-t", "--topic-name", help="Only display topic names."), without_system=True)
def info(output: Output, options: Namespace) -> None:
    """Print information about a bag to the screen."""
    bag_ = Bag(options.bag_path)
    if options.topic_name:
        for name in sorted({channel.topic for _, channel, _ in bag_.messages()}):
            output.print_line(name)
    else:
        output.print_line(bag_.info())


@bag.verb(
    "play",
    PATH,
    argument("-r", "--rate", type=positive_float, default=1.0, help="Rate at which to play back messages"),
    argument("--topics", nargs="+", default=[], metavar="TOPIC", help="Topics to play; all without"),
)
def play(system: System, options: Namespace) -> None:
    """Play back ROS data from a bag."""
    found = [
        (installed_type(schema.name), channel, message)
        for schema, channel, message in Bag(options.bag_path).messages()
        if not options.topics or channel.topic in options.topics
    ]
    if not found:
        raise CliError(f"{options.bag_path} has no such messages.")
    length = (found[-1][2].log_time - found[0][2].log_time) / SECOND / options.rate
    count = system.run_with_node(
        lambda node, output: _play(node, output, found, options.rate), length + 2 * MARGIN
    )
    system.print_line(f"Played {count} messages from {options.bag_path}")


def _play(node: Node, output: Output, found: list[tuple[str, Channel, Any]], rate: float) -> int:
    publishers = {}
    for type_, channel, _ in found:
        if channel.topic not in publishers:
            profile = _profile(channel)
            publishers[channel.topic] = node.create_publisher(message_class(type_), channel.topic, profile)
    clock, first = node.get_clock(), found[0][2].log_time
    clock.sleep_for(rclpy.duration.Duration(seconds=MARGIN / 2))  # until subscriptions have been discovered
    begin = clock.now()
    for count, (_, channel, message) in enumerate(found):
        since = rclpy.duration.Duration(nanoseconds=round((message.log_time - first) / rate))
        clock.sleep_until(begin + since)
        if output.canceled:
            return count
        publishers[channel.topic].publish(message.data)
    clock.sleep_for(rclpy.duration.Duration(seconds=0.1))  # until the last message is sent
    return len(found)


def _profile(channel: Channel) -> QoSProfile:
    """The QoS that the topic was published with; the default if the bag has none."""
    try:
        offered = yaml.safe_load(channel.metadata[QOS])[0]
        reliability = ReliabilityPolicy[RELIABILITIES[offered["reliability"]].upper()]
        durability = DurabilityPolicy[DURABILITIES[offered["durability"]].upper()]
    except (KeyError, IndexError, TypeError, yaml.YAMLError):
        return QoSProfile(depth=10)
    return QoSProfile(depth=10, reliability=reliability, durability=durability)
