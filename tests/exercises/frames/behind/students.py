"""Nodes that follow a leader: right ones, and wrong ones named by their defect."""

import itertools
import math
import threading

import numpy as np
import rclpy
import tf2_geometry_msgs
from geometry_msgs.msg import PointStamped, TransformStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformException, TransformListener

from tests.students.teams import Team

PARTS = "Pilot", "Scout"


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


class Carrot(Follower):
    """A frame of its own, 1 m behind the leader, as in the tutorial on adding a frame: it is looked up as any other."""

    def __init__(self):
        super().__init__()
        carrot = TransformStamped(child_frame_id="carrot")
        carrot.header.frame_id, carrot.header.stamp = "leader/base_link", self.get_clock().now().to_msg()
        carrot.transform.translation.x, carrot.transform.rotation.w = -1.0, 1.0
        self.broadcaster = StaticTransformBroadcaster(self)
        self.broadcaster.sendTransform(carrot)
        self.leader = "carrot"

    def goal(self, found):
        return found.transform.translation.x, found.transform.translation.y


class OwnTree(Follower):
    """Knows tf from linear algebra: matrices in a dictionary, and no Buffer at all."""

    def __init__(self):
        Node.__init__(self, "follower")
        self.parents, self.arrived = {}, {}
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(TFMessage, "/tf", lambda msg: self.keep(msg, False), 100)
        self.create_subscription(TFMessage, "/tf_static", lambda msg: self.keep(msg, True), latched)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.05, self.follow)

    def keep(self, msg, static):
        for one in msg.transforms:
            turn, shift = one.transform.rotation, one.transform.translation
            yaw = 2 * math.atan2(turn.z, turn.w)
            matrix = np.array([[math.cos(yaw), -math.sin(yaw), shift.x], [math.sin(yaw), math.cos(yaw), shift.y], [0, 0, 1]])
            stamp = math.inf if static else one.header.stamp.sec + one.header.stamp.nanosec * 1e-9
            self.parents[one.child_frame_id] = one.header.frame_id, matrix, stamp

    def in_root(self, frame):
        matrix, oldest = np.eye(3), math.inf
        while frame in self.parents:
            frame, step, stamp = self.parents[frame]
            matrix, oldest = step @ matrix, min(oldest, stamp)
        return frame, matrix, oldest

    def follow(self):
        (root, own, _), (other, leader, stamp) = self.in_root("base_link"), self.in_root("leader/base_link")
        age = self.get_clock().now().nanoseconds * 1e-9 - stamp
        if root != other or root == "base_link" or age > 0.4:
            self.publisher.publish(Twist())
            return
        x, y, _ = np.linalg.inv(own) @ leader @ np.array([-1.0, 0.0, 1.0])
        self.drive(x, y)


class PurePursuit(Follower):
    """The arc that leads to the point, from a course on cars; the speed is the leader's own and a share of the error."""

    last, pace = None, 0.0

    def drive(self, x, y):
        command, distance = Twist(), math.hypot(x, y)
        speed = min(0.45, 0.8 * distance + 0.5 * self.pace)
        if distance > 0.12 and x > 0:
            command.linear.x, command.angular.z = speed, max(-1.5, min(1.5, 2 * speed * y / distance**2))
        elif distance > 0.12:
            command.angular.z = math.copysign(1.0, y)
        self.publisher.publish(command)

    def goal(self, found):
        place = self.buffer.lookup_transform("map", self.leader, Time()).transform.translation
        now = self.get_clock().now().nanoseconds * 1e-9
        if self.last is not None:
            x, y, before = self.last
            self.pace = 0.8 * self.pace + 0.2 * math.hypot(place.x - x, place.y - y) / (now - before)
        self.last = place.x, place.y, now
        return super().goal(found)


class States(Follower):
    """A state machine with a name for each state, and the reason of each change in the log."""

    state = "waits"

    def change(self, state):
        if state != self.state:
            self.get_logger().info(f"{self.state} -> {state}")
        self.state = state

    def follow(self):
        x = y = 0.0
        if not self.buffer.can_transform(self.own, self.leader, Time()):
            self.change("waits")
        else:
            found = self.buffer.lookup_transform(self.own, self.leader, Time())
            x, y = self.goal(found)
            far = math.hypot(x, y) > (0.1 if self.state == "follows" else 0.2)
            self.change("lost" if self.is_old(found.header) else "follows" if far else "is there")
        if self.state == "follows":
            self.drive(x, y)
        else:
            self.publisher.publish(Twist())


class EachTransform(Follower):
    """Reacts to transforms as they come; a watchdog stops the robot where none of the leader's has come lately."""

    def __init__(self):
        super().__init__()
        self.seen = None
        self.create_subscription(TFMessage, "/tf", self.on_transforms, 10)

    def on_transforms(self, message):
        if any(one.child_frame_id == "base_link" for one in message.transforms):
            try:
                found = self.buffer.lookup_transform(self.own, self.leader, Time())
            except TransformException:
                return
            if self.seen is None or Time.from_msg(found.header.stamp) > Time.from_msg(self.seen):
                self.seen, self.at = found.header.stamp, self.get_clock().now()
                self.drive(*self.goal(found))

    def follow(self):
        if self.seen is None or self.get_clock().now() - self.at > Duration(seconds=0.5):
            self.publisher.publish(Twist())


class AwaitsTheNext(Follower):
    """A design of its own: each turn awaits the transform of now; a timer of another group ends the wait."""

    waits = 0

    def __init__(self):
        Node.__init__(self, "follower")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.turn, callback_group=ReentrantCallbackGroup())

    async def turn(self):
        self.waits += 1
        if self.waits > 1:
            if self.waits > 6:
                self.publisher.publish(Twist())
            return
        found = await self.buffer.lookup_transform_async(self.own, self.leader, self.get_clock().now())
        self.waits = 0
        self.drive(*self.goal(found))


def main():
    rclpy.init()
    rclpy.spin(Follower())


def loop_of_a_main():
    """As in ROS 1: a thread spins, and the program's own loop looks up, publishes and sleeps."""
    rclpy.init()
    node = rclpy.create_node("follower")
    buffer = Buffer()
    listener = TransformListener(buffer, node)
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    rate = node.create_rate(10)
    while rclpy.ok() and listener:
        command = Twist()
        try:
            found = buffer.lookup_transform("base_link", "leader/base_link", Time(), timeout=Duration(seconds=0.1))
        except TransformException as error:
            node.get_logger().warning(f"no transform: {error}", throttle_duration_sec=2.0)
        else:
            age = (node.get_clock().now() - Time.from_msg(found.header.stamp)).nanoseconds / 1e9
            where, turn = found.transform.translation, found.transform.rotation
            heading = math.atan2(2 * turn.w * turn.z, 1 - 2 * turn.z**2)
            x, y = where.x - math.cos(heading), where.y - math.sin(heading)
            if age < 0.5 and math.hypot(x, y) > 0.15:
                command.linear.x = max(0.0, min(0.4, 1.2 * x))
                command.angular.z = max(-1.2, min(1.2, 2.5 * math.atan2(y, x)))
        publisher.publish(command)
        rate.sleep()


class Pilot(Node):
    """The half that drives: to a point in base_link, as long as points arrive."""

    def __init__(self):
        super().__init__("pilot")
        self.point, self.at = None, self.get_clock().now()
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(PointStamped, "/target", self.on_target, 10)
        self.create_timer(0.1, self.tick)

    def on_target(self, msg):
        self.point, self.at = msg.point, self.get_clock().now()

    def tick(self):
        command = Twist()
        is_new = self.point is not None and self.get_clock().now() - self.at < Duration(seconds=0.5)
        if is_new and math.hypot(self.point.x, self.point.y) > 0.1:
            command.linear.x = max(0.0, min(0.4, self.point.x))
            command.angular.z = max(-1.5, min(1.5, 2.0 * math.atan2(self.point.y, self.point.x)))
        self.publisher.publish(command)


class Scout(Follower):
    """The half that knows frames: publishes the point as long as it is new."""

    def __init__(self):
        super().__init__()
        self.destroy_publisher(self.publisher)
        self.publisher = self.create_publisher(PointStamped, "/target", 10)

    def follow(self):
        try:
            found = self.buffer.lookup_transform(self.own, self.leader, Time())
        except TransformException:
            return
        if not self.is_old(found.header):
            target = PointStamped(header=found.header)
            target.point.x, target.point.y = self.goal(found)
            self.publisher.publish(target)


TwoNodes = Team(Scout, Pilot)


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


class DrivesWithoutFrames(Follower):
    def __init__(self):
        Node.__init__(self, "follower")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, lambda: self.drive(1.0, 0.2))


class WithoutATry(Follower):
    """Looks up at once what comes a second later."""

    def follow(self):
        self.drive(*self.goal(self.buffer.lookup_transform(self.own, self.leader, Time())))


class WaitsForTheLeader(Follower):
    """A callback that waits 10 s for a transform, which the same thread would have to receive."""

    def follow(self):
        found = self.buffer.lookup_transform(self.own, self.leader, self.get_clock().now(), Duration(seconds=10.0))
        self.drive(*self.goal(found))


class OnceIsEnough(Follower):
    """Looks up once, where the leader was then."""

    found = None

    def follow(self):
        if self.found is None:
            try:
                self.found = self.buffer.lookup_transform(self.own, self.leader, Time())
            except TransformException:
                return
        self.drive(*self.goal(self.found))
