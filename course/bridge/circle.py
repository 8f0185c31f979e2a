"""A program that drives in circles; two packages of page 6 have a copy each."""

import signal
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

TURN = 0.6  # rad/s: to the left


class Circle(Node):
    """Drives in a circle."""

    def __init__(self) -> None:
        super().__init__("circle")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, lambda: self.drive(0.3, TURN))

    def drive(self, speed: float, turn: float) -> None:
        """Command a velocity: m/s and rad/s."""
        command = Twist()
        command.linear.x, command.angular.z = speed, turn
        self.publisher.publish(command)


def main() -> None:
    """Drive until Ctrl-C or SIGTERM, then stop the robot."""
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = Circle()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.drive(0.0, 0.0)
        time.sleep(0.2)  # so that it gets there
        node.destroy_node()
        rclpy.try_shutdown()
