"""The goal of lesson 8a: a program that waits for a joint to arrive and refuses positions beyond limits."""

import math

from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

LOWER, UPPER = -2.0, 2.0  # rad
NEAR, SLOW = 0.01, 0.01  # rad, rad/s
PATIENCE = 4.0  # s


class Careful(Node):
    """Moves a joint from one position to the next."""

    def __init__(self):
        super().__init__("careful")
        self.positions = [0.5, -0.5, 9.0, math.nan, 1.0, 0.0]
        self.target, self.since = None, 0.0
        self.publisher = self.create_publisher(Float64, "/joint_commands", 10)
        self.create_subscription(JointState, "/joint_states", self.watch, 10)

    def watch(self, msg):
        """Send the next position when the joint has arrived or is taking too long."""
        index = msg.name.index("joint")
        if self.target is None or self.arrived(msg.position[index], msg.velocity[index]):
            self.go_on()
        elif self.now() - self.since > PATIENCE:
            self.get_logger().error(f"{self.target} rad not reached in {PATIENCE} s: going on")
            self.go_on()

    def arrived(self, position, velocity):
        """Return whether the joint is standing still near its target."""
        return abs(position - self.target) < NEAR and abs(velocity) < SLOW

    def go_on(self):
        """Send the next position that is within the limits."""
        while self.positions and not LOWER <= self.positions[0] <= UPPER:
            self.get_logger().warning(f"Refused: {self.positions.pop(0)} rad is beyond the limits")
        if self.positions:
            self.target, self.since = self.positions.pop(0), self.now()
            self.publisher.publish(Float64(data=self.target))

    def now(self):
        """Return the time in seconds."""
        return self.get_clock().now().nanoseconds / 1e9
