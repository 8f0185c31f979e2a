"""The program listener_serialized: logs the bytes that it receives on the topic chatter."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node
from std_msgs.msg import String

from demo_nodes_py.programs import spin_node


class SerializedSubscriber(Node):
    """Logs each message as bytes."""

    def __init__(self) -> None:
        super().__init__("serialized_subscriber")
        self.subscription = self.create_subscription(String, "chatter", self.listener_callback, 10, raw=True)

    def listener_callback(self, msg: bytes) -> None:
        """Log a serialized message."""
        self.get_logger().info(f'I heard: "{msg!r}"')


def main(args: Sequence[str] | None = None) -> None:
    """Log until Ctrl-C."""
    spin_node(SerializedSubscriber, args)


if __name__ == "__main__":
    main()
