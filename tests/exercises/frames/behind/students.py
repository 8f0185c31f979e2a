"""Nodes that follow a leader: right ones, and wrong ones named by their defect."""

import itertools
import math

import rclpy
import tf2_geometry_msgs
from geometry_msgs.msg import PointStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, TransformException, TransformListener


class Follower(Node):
    """As one would write it; the wrong ones change one thing each."""

    behind, own, leader, near = 1.0, "base_link", "leader/base_link", 0.1

    def __init__(self):
        super().__init__("follower")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.follow)

    def follow(self):
        try:
            found = self.buffer.lookup_transform(self.own, self.leader, Time())
        except TransformException as error:
            self.get_logger().info(str(error))
            self.publisher.publish(Twist())
            return
        if self.is_old(found.header):
            self.publisher.publish(Twist())
        else:
            self.drive(*self.goal(found))

    def is_old(self, header):
        return self.get_clock().now() - Time.from_msg(header.stamp) > Duration(seconds=0.5)

    def goal(self, found):
        point = PointStamped()
        point.point.x = -self.behind
        moved = tf2_geometry_msgs.do_transform_point(point, found).point
        return moved.x, moved.y

    def drive(self, x, y):
        command, distance, angle = Twist(), math.hypot(x, y), math.atan2(y, x)
        if distance > self.near:
            command.linear.x = min(0.4, 1.5 * distance) * max(0.0, math.cos(angle))
            command.angular.z = max(-1.5, min(1.5, 2.0 * angle))
        self.publisher.publish(command)


class ByHand(Follower):
    """A design of its own: computes the point from the quaternion itself."""

    def goal(self, found):
        shift, turn = found.transform.translation, found.transform.rotation
        yaw = 2 * math.atan2(turn.z, turn.w)
        return shift.x - math.cos(yaw), shift.y - math.sin(yaw)


class ByTransform(Follower):
    def follow(self):
        point = PointStamped()
        point.header.frame_id, point.point.x = "leader/base_link", -1.0
        try:
            moved = self.buffer.transform(point, "base_link")
        except TransformException:
            return
        if self.is_old(moved.header):
            moved.point.x = moved.point.y = 0.0
        self.drive(moved.point.x, moved.point.y)


class AsksForAMomentAgo(Follower):
    """A design of its own: looks up where the leader was 0.3 s ago, which fails when nothing new arrives."""

    def follow(self):
        then = self.get_clock().now() - Duration(seconds=0.3)
        try:
            self.drive(*self.goal(self.buffer.lookup_transform(self.own, self.leader, then)))
        except TransformException:
            self.publisher.publish(Twist())


class InTheMap(Follower):
    """Both robots' places in the map, from two lookups; the rest is geometry."""

    def follow(self):
        try:
            own, leader = (self.buffer.lookup_transform("map", frame, Time()) for frame in (self.own, self.leader))
        except TransformException:
            self.publisher.publish(Twist())
            return
        if self.is_old(leader.header):
            self.publisher.publish(Twist())
            return
        x, y, yaw = self.pose(own)
        to_x, to_y, heading = self.target(*self.pose(leader))
        dx, dy = to_x - math.cos(heading) - x, to_y - math.sin(heading) - y
        self.drive(math.cos(yaw) * dx + math.sin(yaw) * dy, math.cos(yaw) * dy - math.sin(yaw) * dx)

    def pose(self, found):
        shift, turn = found.transform.translation, found.transform.rotation
        return shift.x, shift.y, 2 * math.atan2(turn.z, turn.w)

    def target(self, x, y, yaw):
        return x, y, yaw


class FollowsTheTrail(InTheMap):
    """Drives where the leader was when it was 1 m further back; behind a leader that hasn't moved yet, as others."""

    trail = ()

    def target(self, x, y, yaw):
        self.trail = (*self.trail, (x, y))
        far = 0.0
        for (x1, y1), (x2, y2) in itertools.pairwise(reversed(self.trail)):
            far += math.dist((x1, y1), (x2, y2))
            if far >= 1.0:
                return x2 + math.cos(yaw), y2 + math.sin(yaw), yaw
        return x, y, yaw


class TurnsFirst(Follower):
    """Two states: it turns on the spot until it faces the point, and then drives until it is far off it."""

    turning = True

    def drive(self, x, y):
        command, distance, angle = Twist(), math.hypot(x, y), math.atan2(y, x)
        self.turning = abs(angle) > (0.1 if self.turning else 0.5)
        if distance > 0.15:
            command.angular.z = max(-1.5, min(1.5, 3.0 * angle))
            command.linear.x = 0.0 if self.turning else min(0.45, 2.0 * distance)
        self.publisher.publish(command)


def main():
    rclpy.init()
    rclpy.spin(Follower())


class BelievesTheNewest(Follower):
    """Time() is the newest that is known, however old."""

    def is_old(self, header):
        return False


class SaysNothingWhenItIsOld(Follower):
    """Silence isn't a stop."""

    def follow(self):
        found = self.buffer.can_transform(self.own, self.leader, Time())
        if not found or not self.is_old(self.buffer.lookup_transform(self.own, self.leader, Time()).header):
            super().follow()


class AgeOfTheArrival(Follower):
    """Its own robot's transforms arrive all the time."""

    def __init__(self):
        super().__init__()
        self.arrived = self.get_clock().now()
        self.create_subscription(TFMessage, "/tf", self.on_transforms, 10)

    def on_transforms(self, message):
        self.arrived = self.get_clock().now()

    def is_old(self, header):
        return self.get_clock().now() - self.arrived > Duration(seconds=0.5)


class DrivesAtTheLeader(Follower):
    behind = 0.0


class RamsWhoStands(Follower):
    """Drives at a leader that has stood for 2 s."""

    still, last = 0, None

    def goal(self, found):
        place = self.buffer.lookup_transform("map", self.leader, Time()).transform.translation
        self.still = self.still + 1 if place == self.last else 0
        self.last, self.behind = place, 0.0 if self.still > 20 else 1.0
        return super().goal(found)


class HalfTheGap(Follower):
    behind = 0.45


class InFront(Follower):
    behind = -1.0


class Swapped(Follower):
    own, leader = "leader/base_link", "base_link"


class MisspeltFrame(Follower):
    leader = "leader_base_link"


class NeverRests(Follower):
    near = 0.0

    def drive(self, x, y):
        command = Twist()
        command.linear.x = 0.22
        command.angular.z = max(-2.0, min(2.0, 3.0 * math.atan2(y, x)))
        self.publisher.publish(command)


class Silent(Follower):
    def drive(self, x, y):
        self.get_logger().info(f"{x:.2f} {y:.2f}", throttle_duration_sec=1.0)

    def __init__(self):
        super().__init__()
        self.destroy_publisher(self.publisher)
        self.publisher = self.create_publisher(Twist, "/follower/cmd_vel", 10)


class Slow(Follower):
    def drive(self, x, y):
        command = Twist()
        command.linear.x, command.angular.z = 0.1, math.atan2(y, x)
        self.publisher.publish(command)


class OwnOdomForMap(Follower):
    """Takes the numbers of two odometries for places on one map."""

    here = there = None

    def __init__(self):
        super().__init__()
        self.create_subscription(Odometry, "/odom", lambda msg: setattr(self, "here", msg.pose.pose), 10)
        self.create_subscription(
            Odometry, "/leader/odom", lambda msg: setattr(self, "there", msg.pose.pose), 10
        )

    def follow(self):
        if not self.here or not self.there:
            return
        turn = self.here.orientation
        yaw = 2 * math.atan2(turn.z, turn.w)
        dx = self.there.position.x - self.here.position.x
        dy = self.there.position.y - self.here.position.y
        x, y = math.cos(yaw) * dx + math.sin(yaw) * dy, math.cos(yaw) * dy - math.sin(yaw) * dx
        self.drive(x - 1.0, y)


class Degrees(Follower):
    def drive(self, x, y):
        command = Twist()
        command.linear.x = 0.2
        command.angular.z = max(-2.0, min(2.0, math.degrees(math.atan2(y, x))))
        self.publisher.publish(command)


class DrivesWithoutFrames(Follower):
    def __init__(self):
        Node.__init__(self, "follower")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, lambda: self.drive(1.0, 0.2))


class WithoutATry(Follower):
    """Looks up at once what comes a second later."""

    def follow(self):
        self.drive(*self.goal(self.buffer.lookup_transform(self.own, self.leader, Time())))
