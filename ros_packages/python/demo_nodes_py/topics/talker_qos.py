"""The program talker_qos: a talker that is reliable or best effort, and ends after some cycles."""

from __future__ import annotations

from collections.abc import Sequence

from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String

from demo_nodes_py.programs import reliability_name, spin_cycles

PERIOD = 1.0  # seconds


class TalkerQos(Node):
    """Publishes a text each second, with this quality of service."""

    def __init__(self, qos_profile: QoSProfile) -> None:
        super().__init__("talker_qos")
        self.i = 0
        self.get_logger().info(f"{reliability_name(qos_profile)} talker")
        self.pub = self.create_publisher(String, "chatter", qos_profile)
        self.tmr = self.create_timer(PERIOD, self.timer_callback)

    def timer_callback(self) -> None:
        """Publish and log the next text."""
        message = String(data=f"Hello World: {self.i}")
        self.i += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.pub.publish(message)


def main(argv: Sequence[str] | None = None) -> None:
    """Publish until Ctrl-C or the last cycle."""
    spin_cycles(TalkerQos, "number of sending attempts", argv)


if __name__ == "__main__":
    main()
