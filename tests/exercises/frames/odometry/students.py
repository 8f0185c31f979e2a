"""Nodes that broadcast odometry: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from tf2_msgs.msg import TFMessage
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster


class Broadcaster(Node):
    """As one would write it; the wrong ones change one thing each."""

    def __init__(self):
        super().__init__("broadcaster")
        self.broadcaster = self.made()
        self.create_subscription(Odometry, "/wheels/odom", self.on_message, 10)

    def made(self):
        return TransformBroadcaster(self)

    def on_message(self, odom):
        self.broadcaster.sendTransform(self.frame(odom))

    def frame(self, odom):
        sent = TransformStamped(header=odom.header, child_frame_id=odom.child_frame_id)
        sent.transform.translation.x = odom.pose.pose.position.x
        sent.transform.translation.y = odom.pose.pose.position.y
        sent.transform.rotation = odom.pose.pose.orientation
        return sent


class WrittenOut(Broadcaster):
    def frame(self, odom):
        sent = TransformStamped()
        sent.header.stamp = odom.header.stamp
        sent.header.frame_id, sent.child_frame_id = "odom", "base_link"
        position, turn = odom.pose.pose.position, odom.pose.pose.orientation
        sent.transform.translation.x, sent.transform.translation.y = position.x, position.y
        yaw = 2 * math.atan2(turn.z, turn.w)
        sent.transform.rotation.z, sent.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        return sent


def main_with_a_publisher():
    """A design of its own: a publisher in place of the broadcaster."""
    rclpy.init()
    node = rclpy.create_node("broadcaster")
    publisher = node.create_publisher(TFMessage, "tf", 100)

    def on_message(odom):
        sent = TransformStamped(header=odom.header, child_frame_id="base_link")
        sent.transform.translation.x = odom.pose.pose.position.x
        sent.transform.translation.y = odom.pose.pose.position.y
        sent.transform.rotation = odom.pose.pose.orientation
        publisher.publish(TFMessage(transforms=[sent]))

    node.create_subscription(Odometry, "wheels/odom", on_message, 10)
    rclpy.spin(node)


class Swapped(Broadcaster):
    def frame(self, odom):
        sent = super().frame(odom)
        sent.header.frame_id, sent.child_frame_id = "base_link", "odom"
        return sent


class StampedNow(Broadcaster):
    def frame(self, odom):
        sent = super().frame(odom)
        sent.header.stamp = self.get_clock().now().to_msg()
        return sent


class NoStamp(Broadcaster):
    def frame(self, odom):
        sent = super().frame(odom)
        sent.header.stamp.sec = sent.header.stamp.nanosec = 0
        return sent


class NotTurned(Broadcaster):
    def frame(self, odom):
        sent = super().frame(odom)
        sent.transform.rotation.z, sent.transform.rotation.w = 0.0, 1.0
        return sent


class SpeedForPlace(Broadcaster):
    def frame(self, odom):
        sent = super().frame(odom)
        sent.transform.translation.x = odom.twist.twist.linear.x
        return sent


class ByTimer(Broadcaster):
    last = None

    def __init__(self):
        super().__init__()
        self.create_timer(0.25, self.send)

    def on_message(self, odom):
        self.last = odom

    def send(self):
        if self.last:
            self.broadcaster.sendTransform(self.frame(self.last))


class Static(Broadcaster):
    def made(self):
        return StaticTransformBroadcaster(self)


class FirstOnly(Broadcaster):
    """As if the robot stood."""

    sent = False

    def on_message(self, odom):
        if not self.sent:
            super().on_message(odom)
        self.sent = True


class FirstStamp(Broadcaster):
    """Each place with the time of the first one."""

    stamp = None

    def frame(self, odom):
        self.stamp = self.stamp or odom.header.stamp
        sent = super().frame(odom)
        sent.header.stamp = self.stamp
        return sent
