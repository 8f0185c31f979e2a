"""The program listener: logs what it receives on the topic chatter."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node
from std_msgs.msg import String

from demo_nodes_py.programs import spin_node


class Listener(Node):
    """Logs each text."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.sub = self.create_subscription(String, "chatter", self.chatter_callback, 10)

    def chatter_callback(self, msg: String) -> None:
        """Log a text."""
        self.get_logger().info(f"I heard: [{msg.data}]")


def main(args: Sequence[str] | None = None) -> None:
    """Log until Ctrl-C."""
    spin_node(Listener, args)


if __name__ == "__main__":
    main()
