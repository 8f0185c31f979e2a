"""Two programs, for the pictures at the start of the lesson. By its end you can read both of these nodes."""

import math

from geometry_msgs.msg import Twist
from rclpy.node import Node


class Wheels:
    """The robot's wheels. Lesson 2 explains how a node commands them."""

    def __init__(self, node):
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def drive(self, speed, turn):
        """Command a speed, in m/s, and a turning speed, in rad/s, positive to the left."""
        msg = Twist()
        msg.linear.x, msg.angular.z = speed, turn
        self.publisher.publish(msg)


class FigureEight(Node):
    """Drives in circles: one to the left, one to the right, and so on."""

    def __init__(self):
        super().__init__("figure_eight")
        self.wheels = Wheels(self)
        self.turn = math.tau / 8  # a full circle in 8 s
        self.create_timer(0.1, self.drive)
        self.create_timer(8.0, self.change)

    def drive(self):
        """Send the wheels a command."""
        self.wheels.drive(0.4, self.turn)

    def change(self):
        """Turn to the other side from now on."""
        self.turn = -self.turn
        self.get_logger().info("left" if self.turn > 0 else "right")


class Motor(Node):
    """A motor that gets 2 degrees warmer every second and logs it at ever higher levels."""

    def __init__(self):
        super().__init__("motor")
        self.temperature = 40
        self.create_timer(1.0, self.measure)

    def measure(self):
        """Log the temperature, at the level it deserves."""
        self.temperature += 2
        text = f"{self.temperature} degrees"
        if self.temperature < 60:
            self.get_logger().info(text)
        elif self.temperature < 80:
            self.get_logger().warning(text)
        else:
            self.get_logger().error(text)
