"""A program that publishes given messages, tick by tick."""

from collections.abc import Mapping, Sequence
from typing import Any

from rclpy.node import Node
from rclpy.time import Time

Row = tuple[str, Any, int]  # topic, message, and for how many ticks it has been on its way


class Tape(Node):
    """Publishes the messages of each tick; one with a header is stamped with the tick of its measurement.

    rows: of each tick, by its number; the first is 1. period: of a tick, ns. types: of the topics.
    """

    def __init__(
        self, name: str, period: int, types: Mapping[str, type], rows: Mapping[int, Sequence[Row]]
    ) -> None:
        super().__init__(name)
        self.rows, self.period, self.ticks = rows, period, 0
        self.topics = {topic: self.create_publisher(type_, topic, 10) for topic, type_ in types.items()}
        self.begin = self.get_clock().now().nanoseconds
        self.create_timer(period / 1e9, self.tick)

    def tick(self) -> None:
        """Publish what is due now."""
        self.ticks += 1
        for topic, message, late in self.rows.get(self.ticks, ()):
            if hasattr(message, "header"):
                stamp = self.begin + (self.ticks - late) * self.period
                message.header.stamp = Time(nanoseconds=stamp).to_msg()
            self.topics[topic].publish(message)
