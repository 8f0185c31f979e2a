"""Compasses to (5, 5): right ones, and wrong ones named by their defect."""

import math

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from std_msgs.msg import Float32, Float64


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


PARTS = ("yaw_of",)


class Compass(Node):
    """As the notebook has it; the wrong ones change a part."""

    distance_topic, bearing_topic, kind = "/goal/distance", "/goal/bearing", Float64

    def __init__(self):
        super().__init__("compass")
        self.distance_publisher = self.create_publisher(self.kind, self.distance_topic, 10)
        self.bearing_publisher = self.create_publisher(self.kind, self.bearing_topic, 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)

    def on_odom(self, msg):
        pose = msg.pose.pose
        dx, dy = 5.0 - pose.position.x, 5.0 - pose.position.y
        self.distance_publisher.publish(self.kind(data=self.distance(dx, dy)))
        self.bearing_publisher.publish(self.kind(data=self.bearing(dx, dy, pose.orientation)))

    def distance(self, dx, dy):
        return math.hypot(dx, dy)

    def bearing(self, dx, dy, orientation):
        return math.remainder(math.atan2(dy, dx) - yaw_of(orientation), math.tau)


class CompassWithTimer(Node):
    """Keeps the pose, and tells at its own rate; wraps with sine and cosine."""

    def __init__(self):
        super().__init__("pointer")
        self.pose = None
        self.distance = self.create_publisher(Float64, "goal/distance", 1)
        self.bearing = self.create_publisher(Float64, "goal/bearing", 1)
        self.create_subscription(Odometry, "odom", self.keep, 1)
        self.create_timer(0.07, self.tell)

    def keep(self, msg):
        self.pose = msg.pose.pose

    def tell(self):
        if self.pose is None:
            return
        dx, dy = 5.0 - self.pose.position.x, 5.0 - self.pose.position.y
        angle = math.atan2(dy, dx) - yaw_of(self.pose.orientation)
        self.distance.publish(Float64(data=math.sqrt(dx * dx + dy * dy)))
        self.bearing.publish(Float64(data=math.atan2(math.sin(angle), math.cos(angle))))


def compass_main(args=None):
    """A design of its own: one function; turns the goal into the robot's frame."""
    rclpy.init(args=args)
    node = rclpy.create_node("compass")
    distance = node.create_publisher(Float64, "/goal/distance", 10)
    bearing = node.create_publisher(Float64, "/goal/bearing", 10)

    def listen(msg):
        position, yaw = msg.pose.pose.position, yaw_of(msg.pose.pose.orientation)
        goal = complex(5 - position.x, 5 - position.y) * complex(math.cos(yaw), -math.sin(yaw))
        distance.publish(Float64(data=abs(goal)))
        bearing.publish(Float64(data=math.atan2(goal.imag, goal.real)))

    node.create_subscription(Odometry, "/odom", listen, 10)
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()


class AlwaysALittleLate(Compass):
    """Tells what the message before said: 50 ms old, as on any robot."""

    last = None

    def on_odom(self, msg):
        if self.last is not None:
            super().on_odom(self.last)
        self.last = msg


class NotWrapped(Compass):
    def bearing(self, dx, dy, orientation):
        return math.atan2(dy, dx) - yaw_of(orientation) - math.tau


class DirectionInTheWorld(Compass):
    def bearing(self, dx, dy, orientation):
        return math.atan2(dy, dx)


class RightIsPositive(Compass):
    def bearing(self, dx, dy, orientation):
        return -super().bearing(dx, dy, orientation)


class InDegrees(Compass):
    def bearing(self, dx, dy, orientation):
        return math.degrees(super().bearing(dx, dy, orientation))


class AtanOfXAndY(Compass):
    def bearing(self, dx, dy, orientation):
        return math.remainder(math.atan2(dx, dy) - yaw_of(orientation), math.tau)


class ZIsNoAngle(Compass):
    def bearing(self, dx, dy, orientation):
        return math.remainder(math.atan2(dy, dx) - orientation.z, math.tau)


class DistanceFromTheStart(Compass):
    def distance(self, dx, dy):
        return math.hypot(5.0 - dx, 5.0 - dy)


class AlongTheAxes(Compass):
    def distance(self, dx, dy):
        return abs(dx) + abs(dy)


class DistanceSquared(Compass):
    def distance(self, dx, dy):
        return dx**2 + dy**2


class ForgetsTheRobot(Compass):
    """The distance of the start from the goal, all the time."""

    def distance(self, dx, dy):
        return math.hypot(5.0, 5.0)


class Misspelt(Compass):
    distance_topic = "/goal/distence"


class Float32Compass(Compass):
    kind = Float32


class OnlyTheDistance(Compass):
    def on_odom(self, msg):
        position = msg.pose.pose.position
        self.distance_publisher.publish(Float64(data=math.dist((position.x, position.y), (5, 5))))


class WithoutAMessage(Compass):
    def on_odom(self, msg):
        self.distance_publisher.publish(3.5)


class NeverListens(Compass):
    def on_odom(self):
        self.distance_publisher.publish(Float64())


class PointsAway(Compass):
    def bearing(self, dx, dy, orientation):
        return super().bearing(-dx, -dy, orientation)


class HalfATurnLost(Compass):
    def bearing(self, dx, dy, orientation):
        return math.remainder(math.atan2(dy, dx) - yaw_of(orientation), math.pi)


class Swapped(Compass):
    """Publishes the bearing for the distance, and the other way round."""

    distance_topic, bearing_topic = Compass.bearing_topic, Compass.distance_topic
