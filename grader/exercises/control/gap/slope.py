"""The motors of a robot on a slope."""

import math
import random

from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Float64

MOST, PULLS = 0.3, (0.05, 0.1)  # m/s
PATIENCE = 10  # ticks of 0.05 s without a command, until it brakes


class Slope(Node):
    """Takes /speed (Float64, m/s), and drives the robot by /cmd_vel.

    The motors give 0.3 m/s at most, and the robot rolls back by some 5 to 10 cm/s all the time. Half a
    second after the last command, or after one that is no number, they brake.
    """

    def __init__(self) -> None:
        super().__init__("slope")
        self.pull, self.speed, self.left = random.uniform(*PULLS), 0.0, 0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Float64, "/speed", self.obey, 10)
        self.create_timer(0.05, self.roll)

    def obey(self, msg: Float64) -> None:
        """Take a new speed, cut to the limits."""
        self.speed = min(max(msg.data, -MOST), MOST)
        self.left = PATIENCE if math.isfinite(msg.data) else 0

    def roll(self) -> None:
        """Drive and roll back, or brake."""
        command = Twist()
        command.linear.x = self.speed - self.pull if self.left else 0.0
        self.left = max(0, self.left - 1)
        self.publisher.publish(command)
