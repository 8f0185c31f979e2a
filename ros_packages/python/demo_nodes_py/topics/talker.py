"""The program talker: publishes "Hello World: 0" and so on, on the topic chatter."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node
from std_msgs.msg import String

from demo_nodes_py.programs import spin_node

PERIOD = 1.0  # seconds


class Talker(Node):
    """Publishes a text each second."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.i = 0
        self.pub = self.create_publisher(String, "chatter", 10)
        self.tmr = self.create_timer(PERIOD, self.timer_callback)

    def timer_callback(self) -> None:
        """Publish and log the next text."""
        message = String(data=f"Hello World: {self.i}")
        self.i += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.pub.publish(message)


def main(args: Sequence[str] | None = None) -> None:
    """Publish until Ctrl-C."""
    spin_node(Talker, args)


if __name__ == "__main__":
    main()
