"""A robot on a tour of a yard, and a beacon that measures how far away it is."""

import functools
import math
import random
from dataclasses import replace
from typing import ClassVar

from geometry_msgs.msg import PointStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import Range

from grader.companions.blind_drivers import BlindDriver
from grader.companions.drivers import Speeds
from grader.companions.map_messages import posed
from grader.companions.maps import made_for
from grader.companions.qos import LATCHED
from grader.geometry import Pose2D
from grader.worlds.walled import walled
from sim.evidence import Seconds, since_start
from sim.world import World

STARTS: Seconds = 1.0  # when /initialpose is published
LEAVES: Seconds = 2.0  # when the robot sets off
RANGES: Seconds = 19.0  # when the beacon begins
STANDS: Seconds = 38.0  # when the robot stops for good
ENDS: Seconds = 100.0
SPREAD = 0.05, 0.05, 0.05  # m, m, rad: standard deviations of /initialpose
RANGE_SPREAD = 0.15  # m: standard deviation of a distance
SPEED, TURN = 0.3, 0.6  # m/s, rad/s


@functools.lru_cache(maxsize=64)
def tour_yard(seed: int) -> World:
    """Return a large yard. The robot's odometry begins anywhere, and the robot faces along -x at first."""
    draw = random.Random(f"tour {seed}")
    limits = (1.5, 2.0), (-0.5, 0.5), (3.0, 3.1)
    start = tuple(round(draw.uniform(*limit), 2) for limit in limits)
    x, y, yaw = (round(draw.uniform(low, high), 2) for low, high in ((-3, 3), (-3, 3), (-2.5, 2.5)))
    card, bounds = "An empty yard with a beacon.", (-4.0, -4.0, 4.0, 4.0)
    world = walled("tour_yard", seed, bounds, card, start=start)
    silent = replace(world.lidar, silent=((0.0, 1000.0),))  # no node needs scans here
    return replace(world, robot=replace(world.robot, odometry=(x, y, yaw)), lidar=silent)


class Tour(BlindDriver):
    """Drives the robot along the sides of a polygon, and then lets it stand."""

    def __init__(self) -> None:
        super().__init__("tour")
        self.side = random.choice((-1.0, 1.0))
        self.legs = [random.uniform(5.0, 6.0) for _ in range(3)]  # s

    def command(self, now: float) -> Speeds:
        """Ahead for some seconds, then a quarter turn to the same side, and so on."""
        left = now - LEAVES
        if left < 0 or now >= STANDS:
            return 0.0, 0.0
        for number in range(100):
            leg = self.legs[number % 3]
            if left < leg:
                return SPEED, 0.0
            left -= leg
            if left < math.pi / 2 / TURN:
                return 0.0, self.side * TURN
            left -= math.pi / 2 / TURN
        return 0.0, 0.0


class Beacon(Node):
    """Publishes /initialpose once, where the beacon is (/beacon), and later how far the robot is (/range)."""

    world: ClassVar[World]

    def __init__(self) -> None:
        super().__init__("beacon")
        self.pose: tuple[float, float] | None = None
        angle = random.uniform(-math.pi, math.pi)
        self.place = 2.5 * math.cos(angle), 2.5 * math.sin(angle)
        self.ranges = self.create_publisher(Range, "/range", 10)
        self.starts = self.create_publisher(PoseWithCovarianceStamped, "/initialpose", 10)
        self.beacons = self.create_publisher(PointStamped, "/beacon", LATCHED)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.beacons.publish(self.beacon())
        self.timer = self.create_timer(STARTS, self.start)
        self.create_timer(0.2, self.measure)

    def beacon(self) -> PointStamped:
        """The message with the place of the beacon."""
        message = PointStamped()
        message.header.frame_id = "map"
        message.point.x, message.point.y = self.place
        return message

    def start(self) -> None:
        """Publish about where the robot starts, once."""
        self.timer.cancel()
        message = PoseWithCovarianceStamped()
        message.header.frame_id, message.header.stamp = "map", self.get_clock().now().to_msg()
        message.pose.pose = posed(*self.world.start)
        for index, spread in zip((0, 7, 35), SPREAD, strict=True):
            message.pose.covariance[index] = spread**2
        self.starts.publish(message)

    def on_odom(self, msg: Odometry) -> None:
        """Compute where the robot is on the map: its wheels don't slip here."""
        began, moved = Pose2D(*self.world.robot.odometry), Pose2D.from_message(msg.pose.pose)
        start, cos, sin = Pose2D(*self.world.start), math.cos(began.yaw), math.sin(began.yaw)
        dx, dy = moved.x - began.x, moved.y - began.y
        self.pose = start.point((cos * dx + sin * dy, cos * dy - sin * dx))

    def measure(self) -> None:
        """Measure the distance, from a certain time on."""
        now = self.get_clock().now().to_msg()
        if self.pose is None or since_start(now) < RANGES:
            return
        message = Range(radiation_type=Range.INFRARED, min_range=0.0, max_range=20.0)
        message.header.frame_id, message.header.stamp = "beacon", now
        message.range = max(0.0, math.dist(self.pose, self.place) + random.gauss(0.0, RANGE_SPREAD))
        self.ranges.publish(message)


def touring(seed: int) -> list[type[Node]]:
    """Return the driver and the beacon of a yard, as companions of a run."""
    return [Tour, made_for(Beacon, world=tour_yard(seed))]
