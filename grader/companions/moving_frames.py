"""Robots on a curve: one with odometry, and one whose localization comes late."""

import math
import random

from geometry_msgs.msg import PointStamped
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import TransformBroadcaster

from grader.companions.map_messages import posed
from grader.companions.transforms import transform
from grader.geometry import Pose2D
from sim.evidence import since_start

PERIOD, SPEED = 0.1, 0.4  # s, m/s: of the robot with odometry
SWERVE = 0.04  # m, from one moment to the next


class WheelOdometry(Node):
    """Publishes the odometry of a robot that drives a curve on /wheels/odom, a little late."""

    def __init__(self) -> None:
        super().__init__("wheels")
        self.publisher = self.create_publisher(Odometry, "/wheels/odom", 10)
        self.x = self.y = 0.0
        self.yaw = random.uniform(-3.0, 3.0)
        self.turn = random.choice((-1.0, 1.0)) * random.uniform(0.3, 0.8)
        self.create_timer(PERIOD, self.drive)

    def drive(self) -> None:
        """Drive for a period, and publish the odometry."""
        self.yaw = math.remainder(self.yaw + self.turn * PERIOD, math.tau)
        self.x += SPEED * PERIOD * math.cos(self.yaw)
        self.y += SPEED * PERIOD * math.sin(self.yaw)
        odom = Odometry(child_frame_id="base_link")
        age = Duration(seconds=random.uniform(0.01, 0.08))
        odom.header.frame_id, odom.header.stamp = "odom", (self.get_clock().now() - age).to_msg()
        odom.pose.pose = posed(self.x, self.y, self.yaw)
        odom.twist.twist.linear.x, odom.twist.twist.angular.z = SPEED, self.turn
        self.publisher.publish(odom)


class SlowLocalization(Node):
    """A robot on a curve. Publishes what it detects at once (/detection), and its pose (/tf) 0.5 s later."""

    def __init__(self) -> None:
        super().__init__("slow_localization")
        self.broadcaster = TransformBroadcaster(self)
        self.publisher = self.create_publisher(PointStamped, "/detection", 10)
        self.phase, self.delay = random.uniform(-3.0, 3.0), random.choice((8, 10, 12))
        self.waiting: list[tuple[Time, Pose2D]] = []
        self.aside = 0.0  # m off the circle: so that it cannot be predicted
        self.ticks = 0
        self.create_timer(0.05, self.tick)

    def tick(self) -> None:
        """Measure the pose, publish the one measured a while ago, and detect something now and then."""
        now = self.get_clock().now()
        self.aside += random.uniform(-SWERVE, SWERVE)
        x, y, yaw = self.pose_at(now)
        self.waiting.append((now, Pose2D(x + self.aside, y - self.aside, yaw)))
        if len(self.waiting) > self.delay:
            then, pose = self.waiting.pop(0)
            self.broadcaster.sendTransform(transform("map", "base_link", pose, then))
        self.ticks += 1
        if self.ticks % 8 == 0 and self.ticks > self.delay:
            self.detect(now)

    def pose_at(self, when: Time) -> Pose2D:
        """Return the pose on a circle, driven at 1 m/s."""
        angle = self.phase + 0.5 * since_start(when.to_msg())
        yaw = math.remainder(angle + math.pi / 2, math.tau)
        return Pose2D(2.0 * math.cos(angle), 2.0 * math.sin(angle), yaw)

    def detect(self, now: Time) -> None:
        """Publish a point ahead of the robot."""
        point = PointStamped()
        point.header.frame_id, point.header.stamp = "base_link", now.to_msg()
        point.point.x, point.point.y = random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)
        self.publisher.publish(point)
