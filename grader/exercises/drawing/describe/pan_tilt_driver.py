"""A driver of a camera that pans and tilts: it publishes where its two joints are."""

import functools
import random
from collections.abc import Callable

from rclpy.node import Node
from sensor_msgs.msg import JointState

JOINTS = "pan_joint", "tilt_joint"
LIMITS = {"pan_joint": (-1.5, 1.5), "tilt_joint": (-0.5, 1.0)}  # rad
PERIOD = 0.25  # s


class PanTiltDriver(Node):
    """Publishes other positions each time, all within the limits, on /joint_states."""

    def __init__(self, seed: int) -> None:
        super().__init__("pan_tilt_driver")
        self.draw = random.Random(f"pan tilt {seed}")
        self.names = self.draw.sample(JOINTS, 2)
        self.publisher = self.create_publisher(JointState, "/joint_states", 10)
        self.create_timer(PERIOD, self.publish)

    def publish(self) -> None:
        """Publish where the joints are now."""
        state = JointState(name=self.names)
        state.header.stamp = self.get_clock().now().to_msg()
        state.position = [round(self.draw.uniform(*LIMITS[name]), 3) for name in self.names]
        self.publisher.publish(state)


def pan_tilt_driver(seed: int) -> list[Callable[[], Node]]:
    """Return the driver, with positions of a seed."""
    return [functools.partial(PanTiltDriver, seed)]
