"""The program listener_qos: a listener that is reliable or best effort, and ends after some cycles."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String

from demo_nodes_py.programs import reliability_name, spin_cycles


class ListenerQos(Node):
    """Logs each text, with this quality of service."""

    def __init__(self, qos_profile: QoSProfile) -> None:
        super().__init__("listener_qos")
        self.get_logger().info(f"{reliability_name(qos_profile)} listener")
        self.sub = self.create_subscription(String, "chatter", self.chatter_callback, qos_profile)

    def chatter_callback(self, msg: String) -> None:
        """Log a text."""
        self.get_logger().info(f"I heard: [{msg.data}]")


def main(argv: Sequence[str] | None = None) -> None:
    """Log until Ctrl-C or the last cycle."""
    spin_cycles(ListenerQos, "max number of spin_once iterations", argv)


if __name__ == "__main__":
    main()
