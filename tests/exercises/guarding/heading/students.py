"""Compasses: right ones, and wrong ones named by their defect."""

import math

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Float32, Float64


class Compass(Node):
    """As one would write it."""

    type, topic = Float64, "/heading"

    def __init__(self):
        super().__init__("compass")
        self.publisher = self.create_publisher(self.type, self.topic, 10)
        self.create_subscription(Odometry, "/odom", self.look, 10)

    def look(self, msg):
        self.publisher.publish(self.type(data=self.heading(msg.pose.pose.orientation)))

    def heading(self, q):
        return math.degrees(2 * math.atan2(q.z, q.w))


class CompassForAllTurns(Compass):
    """A design of its own: the formula for a robot that tilts, too."""

    def heading(self, q):
        siny_cosp = 2.0 * (q.w * q.z + q.x * q.y)
        cosy_cosp = 1.0 - 2.0 * (q.y * q.y + q.z * q.z)
        return math.degrees(math.atan2(siny_cosp, cosy_cosp))


class CompassWithTimer(Node):
    """Looks ten times a second at the last odometry."""

    def __init__(self):
        super().__init__("compass")
        self.yaw = 0.0
        self.pub = self.create_publisher(Float64, "heading", 10)
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_timer(0.1, lambda: self.pub.publish(Float64(data=self.yaw * 180.0 / math.pi)))

    def on_odom(self, msg):
        q = msg.pose.pose.orientation
        self.yaw = math.copysign(2 * math.acos(min(1.0, abs(q.w))), q.z * q.w)


def main():
    rclpy.init()
    node = rclpy.create_node("compass")
    pub = node.create_publisher(Float64, "/heading", 10)

    def callback(msg):
        z, w = msg.pose.pose.orientation.z, msg.pose.pose.orientation.w
        turn = complex(w, z) ** 2
        pub.publish(Float64(data=math.degrees(math.atan2(turn.imag, turn.real))))

    node.create_subscription(Odometry, "/odom", callback, 10)
    rclpy.spin(node)


class Radians(Compass):
    def heading(self, q):
        return 2 * math.atan2(q.z, q.w)


class ZAsAngle(Compass):
    def heading(self, q):
        return q.z


class DegreesOfZ(Compass):
    def heading(self, q):
        return math.degrees(q.z)


class HalfTheAngle(Compass):
    def heading(self, q):
        return math.degrees(math.atan2(q.z, q.w))


class LosesTheSide(Compass):
    def heading(self, q):
        return math.degrees(2 * math.acos(q.w))


class SwapsArguments(Compass):
    def heading(self, q):
        return math.degrees(2 * math.atan2(q.w, q.z))


class FullTurns(Compass):
    """0 to 360: the same directions, in another range."""

    def heading(self, q):
        return super().heading(q) % 360


class WholeQuaternion(Compass):
    def heading(self, q):
        return q


class Yaw(Compass):
    """There is no yaw in a quaternion."""

    def heading(self, q):
        return q.yaw


class PoseOnce(Compass):
    """The odometry has a pose with covariance, and the pose is in it."""

    def look(self, msg):
        self.publisher.publish(Float64(data=self.heading(msg.pose.orientation)))


class SmallNumbers(Compass):
    type = Float32


class MisspeltTopic(Compass):
    topic = "/headings"


class SumOfRates(Compass):
    """Adds up the odometry's turning rate, with a time step of its own invention."""

    total = 0.0

    def look(self, msg):
        self.total += math.degrees(msg.twist.twist.angular.z) * 0.1
        self.publisher.publish(Float64(data=self.total))


class ForgetsTheArcTangent(Compass):
    """Half of the tutorials' formula."""

    def heading(self, q):
        return math.degrees(2.0 * (q.w * q.z + q.x * q.y))
