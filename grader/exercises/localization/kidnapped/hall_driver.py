"""The programs around a robot that doesn't know where it is: a map, where it is parked, and a driver."""

import math
from collections.abc import Callable
from typing import ClassVar

import numpy as np
from geometry_msgs.msg import PoseArray
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from grader.companions.blind_drivers import BlindDriver
from grader.companions.drivers import Speeds
from grader.companions.map_messages import posed
from grader.companions.maps import MapServer, made_for
from grader.companions.qos import LATCHED
from grader.exercises.localization.kidnapped.hall import Trip, carried_hall, hall, trip, twin
from grader.exercises.localization.localize.scan_matcher import ScanMatcher, composed, relative
from grader.geometry import Pose2D
from sim.evidence import Seconds, since_start
from sim.world import World

SPEED, TURN, AHEAD = 0.5, 1.5, 0.35  # m/s, rad/s, m
NEAR = 0.15  # m from a corner of its route
EVERY = 4  # scans
PARKED: Seconds = 1.0  # so long it stands: by then everyone has its odometry


class Parking(Node):
    """Publishes once, latched, that the robot is parked at one of two places: PoseArray on /parking_poses."""

    trip: ClassVar[Trip]

    def __init__(self) -> None:
        super().__init__("parking")
        here = Pose2D(*self.trip.parked)
        places = sorted([here, twin(here, self.trip.middle)])  # so that the order tells nothing
        message = PoseArray(poses=[posed(*place) for place in places])
        message.header.frame_id = "map"
        self.publisher = self.create_publisher(PoseArray, "/parking_poses", LATCHED)
        self.publisher.publish(message)


class HallDriver(BlindDriver):
    """Follows a route, and publishes nothing but /cmd_vel.

    It knows where the robot starts and where it is put down, and tracks it from there.
    """

    world: ClassVar[World]
    trip: ClassVar[Trip]
    matched: ClassVar[Callable[..., Pose2D]] = ScanMatcher.matched

    def __init__(self) -> None:
        super().__init__("hall_driver")
        self.rng = np.random.default_rng(1)
        self.scans = 0
        self.before = self.odometry = Pose2D(*self.world.robot.odometry)
        self.pose, self.route = Pose2D(*self.trip.start), list(self.trip.first)
        self.is_carried = bool(self.world.robot.carried)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)

    def on_odom(self, msg: Odometry) -> None:
        """Move the pose as the odometry moved."""
        self.odometry = Pose2D.from_message(msg.pose.pose)
        self.pose = composed(self.pose, relative(self.before, self.odometry))
        self.before = self.odometry

    def on_scan(self, scan: LaserScan) -> None:
        """Correct the pose."""
        if self.is_carried and since_start(scan.header.stamp) > self.trip.carried:
            self.is_carried = False
            self.pose, self.route = Pose2D(*self.trip.put_down), list(self.trip.then)
        self.scans += 1
        if self.scans % EVERY == 0:
            self.pose = self.matched(self.pose, scan)

    def command(self, now: float) -> Speeds:
        """Drive to the next corner of the route."""
        if now < PARKED:
            return 0.0, 0.0
        if math.dist(self.pose[:2], self.route[0]) < NEAR:
            self.route = self.route[1:]
        return towards(self.pose, self.route[0])


def towards(pose: Pose2D, corner: tuple[float, float]) -> Speeds:
    """Return the speeds that steer along the x axis through a corner, towards it."""
    aim = pose.x + math.copysign(min(AHEAD, abs(corner[0] - pose.x)), corner[0] - pose.x), corner[1]
    ahead, left, _ = relative(pose, Pose2D(*aim, 0.0))
    bearing = math.atan2(left, ahead)
    if not abs(bearing) <= 0.6:
        return 0.0, math.copysign(TURN, bearing)
    return SPEED, SPEED * 2 * math.sin(bearing) / max(math.hypot(ahead, left), 0.1)


def wandering(seed: int) -> list[type[Node]]:
    """Return a run's programs: a map server, the parking, and the driver of a robot that is carried away."""
    one = trip(seed)
    return [made_for(MapServer, world=hall(seed)), made_for(Parking, trip=one),
            made_for(HallDriver, world=carried_hall(seed), trip=one)]
