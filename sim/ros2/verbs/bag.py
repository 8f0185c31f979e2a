"""ros2 bag: record messages, look at what was recorded, and publish it again."""

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
from sim.ros2.system import System, Voice, Wrong, guess
from sim.ros2.types import existing
from sim.ros2.verbs.publishing import ROUND_OFF, positive_number

bag = Group("bag", "Bags: record messages, look at them, publish them again")
PATH = argument("bag_path", type=Path, help="The folder of a bag, or an .mcap file")


@bag.verb(
    "record",
    argument("topics_positional", nargs="*", metavar="TOPIC", help="Topics to record"),
    argument("--topics", nargs="+", default=[], metavar="TOPIC", help="Topics to record"),
    flag("-a", "--all", help="Record all topics"),
    argument("-o", "--output", type=Path, help="The folder to make; by default it is named by the time"),
)
def record(system: System, asked: Namespace) -> None:
    """Record ROS data to a bag."""
    wanted = [*asked.topics, *asked.topics_positional]
    if not wanted and not asked.all:
        raise Wrong("Need to specify at least one option out of --all, --topics")
    known = system.topics()
    for name in wanted:
        if name not in known:
            system.say(f"WARNING: topic [{name}] does not appear to be published yet{guess(name, known)}")
    for _ in system.listen({}) if system.window is None and not system.over else ():
        known = system.topics()
        if known.keys() >= set(wanted):
            break
    chosen = {name: existing(types[0]) for name, types in known.items() if asked.all or name in wanted}
    if not chosen:
        raise Wrong("There is nothing to record.")
    qos = {end.name: end.qos for end in system.ends if end.kind == "publisher"}
    folder = asked.output or Path(time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    with BagWriter(folder, system.epoch) as writer:
        for name in chosen:
            system.say(f"Subscribed to topic '{name}'")
        try:
            for arrived in system.listen(chosen):
                if arrived is not None:
                    writer.write(arrived, qos.get(arrived.topic, {}))
        finally:
            system.say(f"Recording stopped: {writer.counts.total()} messages in {folder}")


@bag.verb("info", PATH, flag("-t", "--topic-name", help="Only display topic names."), alone=True)
def info(voice: Voice, asked: Namespace) -> None:
    """Print information about a bag to the screen."""
    found = Bag(asked.bag_path)
    if asked.topic_name:
        for name in sorted({channel.topic for _, channel, _ in found.messages()}):
            voice.say(name)
    else:
        voice.say(found.text())


@bag.verb(
    "play",
    PATH,
    argument("-r", "--rate", type=positive_number, default=1.0, help="Rate at which to play back messages"),
    argument("--topics", nargs="+", default=[], metavar="TOPIC", help="Topics to play; all without"),
)
def play(system: System, asked: Namespace) -> None:
    """Play back ROS data from a bag."""
    found = [
        (existing(schema.name), channel, message)
        for schema, channel, message in Bag(asked.bag_path).messages()
        if not asked.topics or channel.topic in asked.topics
    ]
    if not found:
        raise Wrong(f"{asked.bag_path} has no such messages.")
    length = (found[-1][2].log_time - found[0][2].log_time) / SECOND / asked.rate
    count = system.act(lambda node, voice: _play(node, voice, found, asked.rate), length + 2 * ROUND_OFF)
    system.say(f"Played {count} messages from {asked.bag_path}")


def _play(node: Node, voice: Voice, found: list[tuple[str, Channel, Any]], rate: float) -> int:
    publishers = {}
    for type_, channel, _ in found:
        if channel.topic not in publishers:
            profile = _profile(channel)
            publishers[channel.topic] = node.create_publisher(message_class(type_), channel.topic, profile)
    clock, first = node.get_clock(), found[0][2].log_time
    clock.sleep_for(rclpy.duration.Duration(seconds=ROUND_OFF / 2))  # until listeners have found it
    begin = clock.now()
    for count, (_, channel, message) in enumerate(found):
        since = rclpy.duration.Duration(nanoseconds=round((message.log_time - first) / rate))
        clock.sleep_until(begin + since)
        if voice.stopped:
            return count
        publishers[channel.topic].publish(message.data)
    clock.sleep_for(rclpy.duration.Duration(seconds=0.1))  # until the last has gone out
    return len(found)


def _profile(channel: Channel) -> QoSProfile:
    """The settings that the topic was published with; those of a bag that doesn't say are the default."""
    try:
        offered = yaml.safe_load(channel.metadata[QOS])[0]
        reliability = ReliabilityPolicy[RELIABILITIES[offered["reliability"]].upper()]
        durability = DurabilityPolicy[DURABILITIES[offered["durability"]].upper()]
    except (KeyError, IndexError, TypeError, yaml.YAMLError):
        return QoSProfile(depth=10)
    return QoSProfile(depth=10, reliability=reliability, durability=durability)
