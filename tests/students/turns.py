"""Nodes that turn the robot on the spot: to a heading that they never find, or rightly without an end."""

import math

from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

LEFT = Twist(angular=Vector3(z=1.0))


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y**2 + q.z**2))


class Turns(Node):
    """Right: its first command is a turn by 200 degrees."""

    def __init__(self):
        super().__init__("turner")
        self.yaw = self.target = None
        self.turned = False
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_timer(0.1, self.tick)

    def on_odom(self, message):
        self.yaw = yaw_of(message.pose.pose.orientation)
        if self.target is None:
            self.target = self.yaw + math.radians(200)

    def error(self):
        return math.remainder(self.target - self.yaw, math.tau)

    def tick(self):
        if self.yaw is None:
            return
        error = self.error()
        if abs(error) < 0.05:
            self.turned = True
        speed = 0.0 if self.turned else max(-1.0, min(1.0, 1.5 * error))
        self.publisher.publish(Twist(angular=Vector3(z=speed)))


class TurnsWithoutNormalizing(Turns):
    def error(self):
        return self.target - self.yaw


class TurnsToATargetThatMoves(Turns):
    def error(self):
        target = self.yaw + math.pi / 2
        return target - self.yaw


class TurnsByDegrees(TurnsWithoutNormalizing):
    def on_odom(self, message):
        self.yaw, self.target = yaw_of(message.pose.pose.orientation), 90


class TurnsUntilEqual(Turns):
    def tick(self):
        if self.yaw == self.target:
            self.turned = True
        if not self.turned:
            self.publisher.publish(LEFT)


class TurnsInItsSubscription(Node):
    def __init__(self):
        super().__init__("turner")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)

    def on_odom(self, message):
        yaw = yaw_of(message.pose.pose.orientation)
        self.publisher.publish(LEFT if yaw < 3.5 else Twist())


class SpinsAndLogs(Turns):
    """Right: turns forever, and logs its heading."""

    def tick(self):
        if self.yaw is not None:
            self.get_logger().info(f"{self.yaw:.2f}")
        self.publisher.publish(LEFT)


class SpinsAndCounts(Turns):
    """Right: counts how often it has passed one direction."""

    last, rounds = 0.0, 0

    def tick(self):
        if self.yaw is None:
            return
        if self.last < 0.0 <= self.yaw:
            self.rounds += 1
            self.get_logger().info(f"round {self.rounds}")
        self.last = self.yaw
        self.publisher.publish(LEFT)


class TurnsFasterOnOneSide(TurnsInItsSubscription):
    """Right: its speed depends on the heading, and never is 0."""

    def on_odom(self, message):
        yaw = yaw_of(message.pose.pose.orientation)
        self.publisher.publish(Twist(angular=Vector3(z=2.0 if yaw > -0.5 else 1.0)))


class Seeks(Turns):
    """Right: turns until something is near, or it looks back."""

    near = False

    def __init__(self):
        super().__init__()
        self.create_subscription(LaserScan, "/scan", self.on_scan, 10)

    def on_scan(self, message):
        self.near = min(message.ranges) < 0.0

    def tick(self):
        if not self.near or (self.yaw or 0.0) > 4.0:
            self.publisher.publish(LEFT)


class TurnsManyTimes(Turns):
    """Right: turns by an angle of many turns, which it adds up."""

    last, total = None, 0.0

    def on_odom(self, message):
        self.yaw = yaw_of(message.pose.pose.orientation)
        if self.last is not None:
            self.total += math.remainder(self.yaw - self.last, math.tau)
        self.last = self.yaw

    def tick(self):
        self.publisher.publish(LEFT if self.total < 100.0 else Twist())


class AddsUpInFull(TurnsManyTimes):
    def on_odom(self, message):
        self.yaw = yaw_of(message.pose.pose.orientation)
        if self.last is not None:
            self.total = self.total + math.remainder(self.yaw - self.last, math.tau)
        self.last = self.yaw


ENDLESS = (
    *(TurnsWithoutNormalizing, TurnsToATargetThatMoves, TurnsByDegrees, TurnsUntilEqual),
    TurnsInItsSubscription,
)
RIGHT = Turns, SpinsAndLogs, SpinsAndCounts, TurnsFasterOnOneSide, Seeks, TurnsManyTimes, AddsUpInFull
