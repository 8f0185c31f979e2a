"""A program that turns the robot on the spot."""

import functools
import random
from collections.abc import Callable

from geometry_msgs.msg import Twist
from rclpy.node import Node

TURN = 0.3, 0.6  # rad/s


class Turner(Node):
    """Turns the robot on the spot."""

    def __init__(self, seed: int) -> None:
        super().__init__("turner")
        draw = random.Random(f"turner {seed}")
        self.command = Twist()
        self.command.angular.z = draw.choice((-1.0, 1.0)) * draw.uniform(*TURN)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(self.command))


def turner(seed: int) -> list[Callable[[], Node]]:
    """Return the program of a seed, as companions of a run."""
    return [functools.partial(Turner, seed)]
