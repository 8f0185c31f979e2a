"""A program that publishes given messages at given times."""

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile

from sim.evidence import Seconds

Row = tuple[Seconds, str, Any]  # since the node's start, topic, and message


class Schedule(Node):
    """Publishes messages, each once and at its time."""

    def __init__(self, name: str, rows: Sequence[Row], qos: QoSProfile | int = 10) -> None:
        super().__init__(name)
        types = {topic: type(message) for _, topic, message in rows}
        self.topics = {topic: self.create_publisher(type_, topic, qos) for topic, type_ in types.items()}
        for stamp, topic, message in rows:
            self.publish_at(stamp, topic, message)

    def publish_at(self, stamp: Seconds, topic: str, message: Any) -> None:
        """Publish a message once, after so many seconds."""

        def publish() -> None:
            timer.cancel()
            self.topics[topic].publish(message)

        timer = self.create_timer(stamp + 0.5e-9, publish)  # rclpy cuts periods to whole nanoseconds
