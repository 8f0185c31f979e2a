"""A joystick that goes silent, as one with an empty battery or out of range."""

import random

from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile

PERIOD, OFFERED = 0.05, 0.1  # s between two messages, and the deadline that is offered
PAUSE = 1.6  # s
SPEEDS, TURNS = (0.3, 0.4, 0.5), (-0.8, -0.4, 0.0, 0.4, 0.8)


class SilentJoystick(Node):
    """Publishes commands (Twist on /joystick) at 20 Hz, and offers a deadline of 0.1 s.

    Twice it publishes none for 1.6 s: beginning at 2 s to 3.4 s, and at 5.6 s to 7 s, as the seed decides.
    """

    def __init__(self) -> None:
        super().__init__("joystick")
        profile = QoSProfile(depth=1, deadline=Duration(seconds=OFFERED))
        self.publisher = self.create_publisher(Twist, "/joystick", profile)
        self.silent = [random.uniform(2.0, 3.4), random.uniform(5.6, 7.0)]
        self.ticks, self.command = 0, Twist()
        self.create_timer(PERIOD, self.tick)

    def tick(self) -> None:
        """Publish a command, another one every half second; or nothing."""
        self.ticks += 1
        now = self.ticks * PERIOD
        if self.ticks % 10 == 1:
            self.command.linear.x, self.command.angular.z = random.choice(SPEEDS), random.choice(TURNS)
        if not any(begin <= now < begin + PAUSE for begin in self.silent):
            self.publisher.publish(self.command)
