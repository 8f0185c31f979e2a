"""Localizations that publish where odom is: right ones, and wrong ones named after their defect."""

import bisect
import math
from dataclasses import dataclass

import numpy as np
import rclpy
import tf_transformations
from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)

from tests.exercises.localization.poses import yaw_of

PARTS = ("_Frame",)
TOLERANCE = Duration(seconds=0.5)


class Localization(Node):
    """As in the solution; the others change one thing each."""

    parent, child = "map", "odom"
    broadcaster_class = TransformBroadcaster

    def __init__(self):
        super().__init__("localization")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.broadcaster = self.broadcaster_class(self)
        self.publisher = self.create_publisher(PoseWithCovarianceStamped, "/amcl_pose", 10)
        for topic in ("/initialpose", "/scan_pose"):
            self.create_subscription(PoseWithCovarianceStamped, topic, self.on_pose, 10)

    def on_pose(self, msg):
        self.report(msg)
        position = msg.pose.pose.position
        pose = position.x, position.y, yaw_of(msg.pose.pose.orientation)
        self.send(self.product(pose, self.odometry(msg.header.stamp)), self.stamp(msg))

    def report(self, msg):
        self.publisher.publish(msg)

    def odometry(self, stamp):
        try:
            found = self.buffer.lookup_transform("odom", "base_link", stamp).transform
        except TransformException:
            found = self.buffer.lookup_transform("odom", "base_link", Time()).transform
        return found.translation.x, found.translation.y, yaw_of(found.rotation)

    def product(self, pose, odometry):
        turn = pose[2] - odometry[2]
        cos, sin = math.cos(turn), math.sin(turn)
        x, y = odometry[:2]
        return pose[0] - cos * x + sin * y, pose[1] - sin * x - cos * y, turn

    def stamp(self, msg):
        return (Time.from_msg(msg.header.stamp) + TOLERANCE).to_msg()

    def send(self, place, stamp):
        sent = TransformStamped(child_frame_id=self.child)
        sent.header.frame_id, sent.header.stamp = self.parent, stamp
        sent.transform.translation.x, sent.transform.translation.y = place[:2]
        sent.transform.rotation.z, sent.transform.rotation.w = math.sin(place[2] / 2), math.cos(place[2] / 2)
        self.broadcaster.sendTransform(sent)


class Matrices(Localization):
    """4 by 4 matrices of tf_transformations."""

    def product(self, pose, odometry):
        def matrix(x, y, yaw):
            made = tf_transformations.euler_matrix(0.0, 0.0, yaw)
            made[:2, 3] = x, y
            return made

        found = matrix(*pose) @ np.linalg.inv(matrix(*odometry))
        return found[0, 3], found[1, 3], math.atan2(found[1, 0], found[0, 0])


class Complex(Localization):
    """A design of its own: points are complex numbers, and a rotation is a factor."""

    def product(self, pose, odometry):
        turn = pose[2] - odometry[2]
        place = complex(*pose[:2]) - complex(*odometry[:2]) * complex(math.cos(turn), math.sin(turn))
        return place.real, place.imag, turn


class InverseFromTf(Localization):
    """A design of its own: the buffer gives the inverse, odom in base_link."""

    def odometry(self, stamp):
        try:
            found = self.buffer.lookup_transform("base_link", "odom", stamp).transform
        except TransformException:
            found = self.buffer.lookup_transform("base_link", "odom", Time()).transform
        return found.translation.x, found.translation.y, yaw_of(found.rotation)

    def product(self, pose, back):
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        x, y = back[:2]
        return pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y, pose[2] + back[2]


class OdometryByHand(Localization):
    """A design of its own: /odom with its stamps in a list, and no buffer."""

    def __init__(self):
        super().__init__()
        self.history = []
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)

    def on_odom(self, msg):
        pose = msg.pose.pose
        here = pose.position.x, pose.position.y, yaw_of(pose.orientation)
        self.history = [*self.history[-100:], (Time.from_msg(msg.header.stamp).nanoseconds, here)]

    def odometry(self, stamp):
        wanted = Time.from_msg(stamp).nanoseconds
        return min(self.history, key=lambda row: abs(row[0] - wanted))[1]


def main_with_a_publisher():
    """A design of its own: a publisher in place of the broadcaster."""
    rclpy.init()
    node = Localization()
    publisher = node.create_publisher(TFMessage, "/tf", 10)
    node.broadcaster.sendTransform = lambda sent: publisher.publish(TFMessage(transforms=[sent]))
    rclpy.spin(node)


@dataclass(frozen=True)
class _Frame:
    x: float
    y: float
    yaw: float

    def __matmul__(self, other):
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return _Frame(
            self.x + cos * other.x - sin * other.y, self.y + sin * other.x + cos * other.y, self.yaw + other.yaw
        )

    def inverse(self):
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return _Frame(-cos * self.x - sin * self.y, sin * self.x - cos * self.y, -self.yaw)


class Frames(Localization):
    """A design of its own: a small class for poses, with a product and an inverse."""

    def product(self, pose, odometry):
        found = _Frame(*pose) @ _Frame(*odometry).inverse()
        return found.x, found.y, found.yaw


class Quaternions(Localization):
    """A design of its own: rotations stay quaternions, as in the messages."""

    def product(self, pose, odometry):
        turned, back = (tf_transformations.quaternion_from_euler(0.0, 0.0, each[2]) for each in (pose, odometry))
        turn = tf_transformations.quaternion_multiply(turned, tf_transformations.quaternion_inverse(back))
        moved = tf_transformations.quaternion_matrix(turn) @ (*odometry[:2], 0.0, 1.0)
        yaw = tf_transformations.euler_from_quaternion(turn)[2]
        return pose[0] - moved[0], pose[1] - moved[1], yaw


class Awaits(Localization):
    """A design of its own: an async callback awaits the odometry of that time."""

    async def on_pose(self, msg):
        self.report(msg)
        stamp = Time.from_msg(msg.header.stamp)
        found = (await self.buffer.lookup_transform_async("odom", "base_link", stamp)).transform
        position = msg.pose.pose.position
        pose = position.x, position.y, yaw_of(msg.pose.pose.orientation)
        odometry = found.translation.x, found.translation.y, yaw_of(found.rotation)
        self.send(self.product(pose, odometry), self.stamp(msg))


class Interpolates(OdometryByHand):
    """A design of its own: odometry by hand, and between two messages a mixture of both."""

    def odometry(self, stamp):
        wanted = Time.from_msg(stamp).nanoseconds
        stamps = [row[0] for row in self.history]
        after = min(bisect.bisect_left(stamps, wanted), len(stamps) - 1)
        (t0, a), (t1, b) = self.history[max(after - 1, 0)], self.history[after]
        share = min(max((wanted - t0) / (t1 - t0), 0.0), 1.0) if t1 > t0 else 0.0
        turn = math.remainder(b[2] - a[2], math.tau)
        return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * turn


class SendsAgain(Localization):
    """A design of its own: a timer sends the last correction, with the stamp of its scan, until the next."""

    def __init__(self):
        super().__init__()
        self.last = None
        self.create_timer(0.02, self.repeat)

    def send(self, place, stamp):
        self.last = place, stamp

    def repeat(self):
        if self.last is not None:
            super().send(*self.last)
            self.last = None


def main_with_two_threads():
    """A design of its own: a buffer that spins in a thread of its own."""
    rclpy.init()
    node = Localization()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


# -- wrong ones --


class Silent(Localization):
    def on_pose(self, msg):
        pass


class TwoParents(Localization):
    """Publishes where base_link is in map, though base_link has a parent."""

    child = "base_link"

    def product(self, pose, odometry):
        return pose


class BaseForOdom(Localization):
    def product(self, pose, odometry):
        return pose


class Static(Localization):
    broadcaster_class = StaticTransformBroadcaster


class OtherWayRound(Localization):
    parent, child = "odom", "map"


class WrongOrder(Localization):
    def product(self, pose, odometry):
        cos, sin = math.cos(odometry[2]), math.sin(odometry[2])
        dx, dy = pose[0] - odometry[0], pose[1] - odometry[1]
        return cos * dx + sin * dy, cos * dy - sin * dx, pose[2] - odometry[2]


class NotInverted(Localization):
    def product(self, pose, odometry):
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        x, y = odometry[:2]
        return pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y, pose[2] + odometry[2]


class Subtracts(Localization):
    def product(self, pose, odometry):
        return tuple(a - b for a, b in zip(pose, odometry, strict=True))


class NewestOdometry(Localization):
    def odometry(self, stamp):
        return super().odometry(Time())


class StampedNow(Localization):
    def stamp(self, msg):
        return self.get_clock().now().to_msg()


class NoTolerance(Localization):
    def stamp(self, msg):
        return msg.header.stamp


class NoStamp(Localization):
    def stamp(self, msg):
        return Time().to_msg()


class OnlyTheClick(Localization):
    """Trusts the odometry from the click on."""

    def on_pose(self, msg):
        if msg.pose.covariance[0] > 0.005:
            super().on_pose(msg)


class CertainPose(Localization):
    """Publishes a pose without a covariance."""

    def report(self, msg):
        certain = PoseWithCovarianceStamped(header=msg.header)
        certain.pose.pose = msg.pose.pose
        self.publisher.publish(certain)


class NoAmclPose(Localization):
    def report(self, msg):
        pass


class NotARotation(Localization):
    """Puts the yaw into the quaternion."""

    def send(self, place, stamp):
        sent = TransformStamped(child_frame_id=self.child)
        sent.header.frame_id, sent.header.stamp = self.parent, stamp
        sent.transform.translation.x, sent.transform.translation.y = place[:2]
        sent.transform.rotation.z = place[2]
        self.broadcaster.sendTransform(sent)
