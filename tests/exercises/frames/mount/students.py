"""Nodes that say where a lidar sits: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import Pose2D, TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster
from tf_transformations import quaternion_from_euler

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Mount(Node):
    """As one would write it; the wrong ones change one thing each."""

    parent, child, kind = "base_link", "base_scan", StaticTransformBroadcaster

    def __init__(self):
        super().__init__("mount")
        self.broadcaster = self.kind(self)
        self.create_subscription(Pose2D, "/mounting", self.on_message, LATCHED)

    def on_message(self, msg):
        sent = TransformStamped()
        sent.header.stamp = self.get_clock().now().to_msg()
        sent.header.frame_id, sent.child_frame_id = self.parent, self.child
        sent.transform.translation.x, sent.transform.translation.y = msg.x, msg.y
        self.turn(sent.transform.rotation, msg.theta)
        self.send(sent)

    def turn(self, rotation, theta):
        rotation.z, rotation.w = math.sin(theta / 2), math.cos(theta / 2)

    def send(self, sent):
        self.broadcaster.sendTransform(sent)


class ByEuler(Mount):
    def turn(self, rotation, theta):
        rotation.x, rotation.y, rotation.z, rotation.w = map(float, quaternion_from_euler(0.0, 0.0, theta))


def main_with_a_publisher():
    """A design of its own: a latched publisher in place of the broadcaster."""
    rclpy.init()
    node = rclpy.create_node("mount")
    publisher = node.create_publisher(TFMessage, "tf_static", LATCHED)

    def on_message(msg):
        sent = TransformStamped(child_frame_id="base_scan")
        sent.header.frame_id = "base_link"
        sent.transform.translation.x, sent.transform.translation.y = msg.x, msg.y
        sent.transform.rotation.z, sent.transform.rotation.w = (
            math.sin(msg.theta / 2),
            math.cos(msg.theta / 2),
        )
        publisher.publish(TFMessage(transforms=[sent]))

    node.create_subscription(Pose2D, "mounting", on_message, LATCHED)
    rclpy.spin(node)


class Swapped(Mount):
    parent, child = "base_scan", "base_link"


class OtherFrame(Mount):
    child = "laser"


class Moving(Mount):
    kind = TransformBroadcaster


class AngleInZ(Mount):
    def turn(self, rotation, theta):
        rotation.z, rotation.w = theta, 1.0


class WholeAngle(Mount):
    def turn(self, rotation, theta):
        rotation.z, rotation.w = math.sin(theta), math.cos(theta)


class NotTurned(Mount):
    def turn(self, rotation, theta):
        rotation.w = 1.0


class Degrees(Mount):
    def turn(self, rotation, theta):
        super().turn(rotation, math.radians(theta))


class ForgetsY(Mount):
    def send(self, sent):
        sent.transform.translation.y = 0.0
        super().send(sent)


class AgainAndAgain(Mount):
    last = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.5, self.repeat)

    def send(self, sent):
        self.last = sent
        super().send(sent)

    def repeat(self):
        if self.last:
            self.broadcaster.sendTransform(self.last)


class NotKept(Mount):
    def __init__(self):
        Node.__init__(self, "mount")
        self.broadcaster = StaticTransformBroadcaster(self, qos=10)
        self.create_subscription(Pose2D, "/mounting", self.on_message, LATCHED)


class AllZeros(Mount):
    """No turn is 0, 0, 0 and 1, and all zeros is none at all."""

    def turn(self, rotation, theta):
        rotation.w = 0.0
