"""ros2 bag play: publish the messages of a bag again."""

from __future__ import annotations

from argparse import ArgumentTypeError, Namespace
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import rclpy
from mcap.records import Channel
from rclpy.duration import Duration
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from sim.nanoseconds import SECOND, Nanoseconds
from sim.ros.bags.bag_files import Bag
from sim.ros.bags.played import metadata_qos
from sim.ros.bags.qos import offered_profile
from sim.ros.bags.sqlite import QOS
from sim.ros.messages.codec import message_class
from sim.ros2.group import argument, flag
from sim.ros2.interface_types import installed_type
from sim.ros2.system import CliError, Output, System
from sim.ros2.topic_selection import EXCLUDING, TopicSelection
from sim.ros2.verbs.bag import PATH, READ_STORAGE, bag
from sim.ros2.verbs.publishing import MARGIN, positive_float

CLOCK = "/clock"


def not_negative_float(text: str) -> float:
    """The value of an option that must be a number, 0 or more."""
    try:
        number = float(text)
    except ValueError:
        raise ArgumentTypeError(f"{text} is not the valid type (float)") from None
    if not number >= 0:
        raise ArgumentTypeError(f"Value {text} is less than zero.")
    return number


@bag.verb(
    "play",
    PATH,
    READ_STORAGE,
    argument("-r", "--rate", type=positive_float, default=1.0, help="Rate at which to play back messages"),
    argument("--topics", nargs="+", default=[], metavar="TOPIC", help="Topics to play; all without"),
    *EXCLUDING,
    argument("-x", "--exclude-regex", default="", help="Leave out what contains this regular expression"),
    argument("-m", "--remap", nargs="+", default=[], metavar="OLD:=NEW", help="Topics to be remapped"),
    flag("-l", "--loop", help="Start again at the end, until Ctrl-C"),
    argument(
        "--clock",
        type=positive_float,
        nargs="?",
        const=40.0,
        metavar="HZ",
        help="Publish the bag's time on /clock, at 40 Hz by default",
    ),
    argument("-d", "--delay", type=positive_float, default=0.0, help="s to sleep before each loop"),
    argument("--start-offset", type=not_negative_float, default=0.0, help="s into the bag to start at"),
    argument("--playback-duration", type=float, default=-1.0, help="s to play; all of it if negative"),
    argument("--read-ahead-queue-size", type=int, help="Changes nothing: the bag is read first"),
    flag("--disable-keyboard-controls", help="Changes nothing: there are none"),
    flag("--disable-loan-message", help="Changes nothing: messages are not loaned"),
)
def play(system: System, options: Namespace) -> None:
    """Play back ROS data from a bag."""
    if options.clock and system.time_limit is not None:
        raise CliError("`--clock` is for a terminal: here all clocks show the simulated time of the play.")
    found = list(_selected(options))
    if not found:
        raise CliError(f"{options.bag_path} has no such messages.")
    length = (found[-1][2].log_time - found[0][2].log_time) / SECOND / options.rate + options.delay
    limit = system.time_limit if options.loop else length + 2 * MARGIN
    topics, again = {channel.topic for _, channel, _ in found}, ", again and again" if options.loop else ""
    system.print_line(f"Playing {len(found)} messages on {', '.join(sorted(topics))}: {length:.1f} s{again}")
    count = system.run_with_node(lambda node, output: BagPlayer(node, output, options).play(found), limit)
    system.print_line(f"Played {count} messages from {options.bag_path}")


def _selected(options: Namespace) -> Iterator[tuple[str, Channel, Any]]:
    """Type, channel and message of what these options select."""
    selection = TopicSelection.of(options)
    everything = not (options.topics or options.regex)
    selection.all_topics = selection.all_services = selection.include_hidden_topics = everything
    begin: Nanoseconds | None = None
    for schema, channel, message in Bag(options.bag_path).messages():
        begin = message.log_time if begin is None else begin
        since = message.log_time - begin - round(options.start_offset * SECOND)
        late = 0 <= round(options.playback_duration * SECOND) < since
        replaced = options.clock and channel.topic == CLOCK
        if since >= 0 and not late and not replaced and selection.includes(channel.topic, schema.name):
            yield installed_type(schema.name), channel, message


@dataclass
class BagPlayer:
    """Publishes messages at the times of a bag, and the bag's time on /clock."""

    node: Node
    output: Output
    options: Namespace
    publishers: dict[str, Any] = field(default_factory=dict)

    def play(self, found: list[tuple[str, Channel, Any]]) -> int:
        """Play these messages; returns how many it published."""
        stored = metadata_qos(self.options.bag_path)
        for type_, channel, _ in found:
            if channel.topic not in self.publishers:
                kind, name = message_class(type_), self._remapped(channel.topic)
                profile = offered_profile(channel.metadata.get(QOS) or stored.get(channel.topic, ""))
                self.publishers[channel.topic] = self.node.create_publisher(kind, name, profile)
        if self.options.clock:
            self.publishers[CLOCK] = self.node.create_publisher(Clock, CLOCK, 1)
        self._sleep(MARGIN / 2)  # until subscriptions have been discovered
        count = self._once(found)
        while self.options.loop and not self.output.canceled:
            count += self._once(found)
        self._sleep(0.1)  # until the last message is sent
        return count

    def _once(self, found: list[tuple[str, Channel, Any]]) -> int:
        self._sleep(self.options.delay)
        clock, first, count = self.node.get_clock(), found[0][2].log_time, 0
        begin = clock.now()
        for moment, channel, message in self._timeline(found):
            clock.sleep_until(begin + Duration(nanoseconds=round((moment - first) / self.options.rate)))
            if self.output.canceled or not self.node.context.ok():
                break
            if channel is None:
                time = rclpy.time.Time(nanoseconds=moment).to_msg()
                self.publishers[CLOCK].publish(Clock(clock=time))
            else:
                self.publishers[channel.topic].publish(message.data)
                count += 1
        return count

    def _timeline(
        self, found: list[tuple[str, Channel, Any]]
    ) -> Iterator[tuple[Nanoseconds, Channel | None, Any]]:
        """The messages with their times, and between them those at which the clock is published."""
        tick = found[0][2].log_time
        for _, channel, message in found:
            while self.options.clock and tick <= message.log_time:
                yield tick, None, None
                tick += round(SECOND * self.options.rate / self.options.clock)
            yield message.log_time, channel, message

    def _remapped(self, topic: str) -> str:
        rules: list[str] = self.options.remap
        for rule in rules:
            old, mark, new = rule.partition(":=")
            if not mark:
                raise CliError(f"{rule!r} is not a remapping, such as /old:=/new.")
            if old in (topic, topic.removeprefix("/")):
                return new
        return topic

    def _sleep(self, seconds: float) -> None:
        if seconds:
            self.node.get_clock().sleep_for(Duration(seconds=seconds))
