"""Programs around a localization: a scan matcher, a click on the map, and a driver that trusts /tf."""

import functools
import math
import random
from collections import deque
from dataclasses import replace
from typing import ClassVar

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_ros import Buffer, TransformException, TransformListener

from grader.companions.blind_drivers import BlindDriver
from grader.companions.drivers import Speeds
from grader.companions.map_messages import posed
from grader.companions.maps import MapServer, made_for
from grader.geometry import Pose2D
from grader.geometry.ground import RESOLUTION, drivable, ground
from grader.worlds.slippery import slippery
from sim.evidence import since_start
from sim.world import World

CLICKED = 1.0  # s: when a person clicks where the robot is; in each order /tf has come by then
MATCHED = 1.0  # s: when the scan matcher begins
EVERY = 8  # scans
GUESSES, SIGMA, RANDOM = 300, 0.1, 0.2
AHEAD, SPEED, NEAR = 0.3, 0.3, 0.1  # m, m/s, m from the goal
FRESH = Duration(seconds=1.0)  # so old a transform may be


@functools.lru_cache(maxsize=64)
def slippery_room(seed: int) -> World:
    """Return a room for a robot with bad wheels, whose odometry begins anywhere."""
    draw = random.Random(f"slippery {seed}")
    world = World.generate("room", seed=seed, width=7.0, height=5.0, boxes=3)
    x, y, yaw = (round(draw.uniform(low, high), 2) for low, high in ((-4, 4), (-4, 4), (-3, 3)))
    left = draw.choice((0.98, 1.02))
    bad = slippery(world, left=left)
    return replace(bad, name=f"slippery_room_{seed}", robot=replace(world.robot, odometry=(x, y, yaw)))


def relative(a: Pose2D, b: Pose2D) -> Pose2D:
    """Return the pose b in the frame of the pose a."""
    cos, sin = math.cos(a.yaw), math.sin(a.yaw)
    dx, dy = b.x - a.x, b.y - a.y
    return Pose2D(cos * dx + sin * dy, cos * dy - sin * dx, math.remainder(b.yaw - a.yaw, math.tau))


def composed(a: Pose2D, b: Pose2D) -> Pose2D:
    """Return the pose b, given in the frame of the pose a, in the frame of a's numbers."""
    return Pose2D(*a.point(b[:2]), math.remainder(a.yaw + b.yaw, math.tau))


class ScanMatcher(Node):
    """Publishes where the robot was at a scan, some time later: PoseWithCovarianceStamped on /scan_pose.

    It also publishes /initialpose once, as a person does who clicks in RViz.
    """

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("scan_matcher")
        self.rng = np.random.default_rng(random.randrange(2**32))
        self.delay, self.count = random.uniform(0.25, 0.4), 0
        self.pose, self.before = Pose2D(*self.world.start), Pose2D(*self.world.robot.odometry)
        self.odometry, self.late = self.before, deque[PoseWithCovarianceStamped]()
        self.fixes = self.create_publisher(PoseWithCovarianceStamped, "/scan_pose", 10)
        self.clicks = self.create_publisher(PoseWithCovarianceStamped, "/initialpose", 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.timer = self.create_timer(CLICKED, self.click)
        self.create_timer(0.05, self.publish)

    def on_odom(self, msg: Odometry) -> None:
        """Store the odometry."""
        self.odometry = Pose2D.from_message(msg.pose.pose)

    def on_scan(self, scan: LaserScan) -> None:
        """Match every eighth scan with the map."""
        self.count += 1
        if self.count % EVERY or since_start(scan.header.stamp) < MATCHED:
            return
        start = composed(self.pose, relative(self.before, self.odometry))
        self.before, self.pose = self.odometry, self.matched(start, scan)
        self.late.append(self.message(scan.header.stamp, 0.03))

    def matched(self, start: Pose2D, scan: LaserScan) -> Pose2D:
        """Return the mean of guesses around a pose, weighed by a scan."""
        guesses = np.array(start) + self.rng.normal(size=(GUESSES, 3)) * (0.06, 0.06, 0.06)
        ranges = np.array(scan.ranges)[::12]
        angles = scan.angle_min + np.arange(len(ranges)) * 12 * scan.angle_increment
        hit = np.isfinite(ranges)
        x, y, yaw = guesses.T[:, :, None]
        floor = ground(self.world)
        ends = (x + ranges[hit] * np.cos(yaw + angles[hit]), y + ranges[hit] * np.sin(yaw + angles[hit]))
        column, row = (((end - low) // RESOLUTION).astype(int)
                       for end, low in zip(ends, floor.origin, strict=True))
        high, wide = floor.clearance.shape
        gaps = floor.clearance[row.clip(0, high - 1), column.clip(0, wide - 1)]
        logs = np.log((1 - RANDOM) * np.exp(-(gaps**2) / (2 * SIGMA**2)) + RANDOM).sum(axis=1)
        weights = np.exp(logs - logs.max())
        return Pose2D(*map(float, weights @ guesses / weights.sum()))

    def message(self, stamp: Time, spread: float) -> PoseWithCovarianceStamped:
        """The newest pose, with a standard deviation (m and rad)."""
        message = PoseWithCovarianceStamped()
        message.header.frame_id, message.header.stamp = "map", stamp
        message.pose.pose = posed(*self.pose)
        for index in (0, 7, 35):
            message.pose.covariance[index] = spread**2
        return message

    def click(self) -> None:
        """Publish where the robot starts, once."""
        self.timer.cancel()
        self.clicks.publish(self.message(self.get_clock().now().to_msg(), 0.1))

    def publish(self) -> None:
        """Publish what has been computed by now."""
        now = since_start(self.get_clock().now().to_msg())
        while self.late and since_start(self.late[0].header.stamp) + self.delay <= now:
            self.fixes.publish(self.late.popleft())


class PathDriver(BlindDriver):
    """Drives along a path on the map, by /tf alone; without a fresh transform it stops."""

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("path_driver")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.path = list(drivable(self.world))

    def command(self, now: float) -> Speeds:
        """Pure pursuit; zeros at the goal."""
        try:
            found = self.buffer.lookup_transform("map", "base_link", Time())
        except TransformException:
            return 0.0, 0.0
        pose = Pose2D.from_message(found.transform)
        age = self.get_clock().now() - Time.from_msg(found.header.stamp)
        if age > FRESH or not all(map(math.isfinite, pose)) or math.dist(pose[:2], self.path[-1]) < NEAR:
            return 0.0, 0.0
        gaps = [math.dist(pose[:2], point) for point in self.path]
        self.path = self.path[gaps.index(min(gaps)):]
        point = next((one for one in self.path if not math.dist(one, pose[:2]) < AHEAD), self.path[-1])
        ahead, left, _ = relative(pose, Pose2D(*point, 0.0))
        bearing = math.atan2(left, ahead)
        if not abs(bearing) <= 1.0:
            return 0.0, math.copysign(1.2, bearing)
        return SPEED, SPEED * 2 * math.sin(bearing) / math.hypot(ahead, left)


def matching(seed: int) -> list[type[Node]]:
    """Return the map server, the scan matcher and the driver for a room, as companions of a run."""
    world = slippery_room(seed)
    return [made_for(node, world=world) for node in (MapServer, ScanMatcher, PathDriver)]
