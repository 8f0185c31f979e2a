"""Nodes that move the joint."""

import math

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

SEVEN = [0.5, -0.5, 1.5, 9.0, -9.0, 1.0, 0.0]


class Seven(Node):
    """Seven positions, one every two seconds."""

    def __init__(self):
        super().__init__("seven")
        self.publisher = self.create_publisher(Float64, "joint_commands", 10)
        self.positions = list(SEVEN)
        self.create_timer(2.0, self.send)

    def send(self):
        if self.positions:
            self.publisher.publish(Float64(data=self.positions.pop(0)))


def seven_and_done():
    """The same in a main() that ends when all are sent."""
    rclpy.init()
    node = Seven()
    while rclpy.ok() and node.positions:
        rclpy.spin_once(node)
    node.destroy_node()
    rclpy.shutdown()


class SevenThenGone(Seven):
    """Destroys itself and shuts down from its own timer."""

    def send(self):
        super().send()
        if not self.positions:
            self.destroy_node()
            rclpy.shutdown()


class Swinger(Node):
    """A new position ten times a second, long before the last is reached; says how fast the joint gets."""

    def __init__(self):
        super().__init__("swinger")
        self.publisher = self.create_publisher(Float64, "joint_commands", 10)
        self.create_subscription(JointState, "joint_states", self.on_joint, 10)
        self.create_timer(0.1, self.send)
        self.fastest, self.begin = 0.0, self.get_clock().now()

    def on_joint(self, joint):
        self.fastest = max(self.fastest, abs(joint.velocity[0]))

    def send(self):
        now = (self.get_clock().now() - self.begin).nanoseconds / 1e9
        self.publisher.publish(Float64(data=3.0 * math.sin(7.0 * now)))


class NoNumber(Seven):
    def send(self):
        self.publisher.publish(Float64(data=math.inf))

    def __init__(self):
        super().__init__()
        self.create_timer(0.1, self.send)


class Flood(Seven):
    """Ten thousand commands a second."""

    def __init__(self):
        super().__init__()
        self.create_timer(0.0001, lambda: self.publisher.publish(Float64(data=1.0)))
