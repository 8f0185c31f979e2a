"""Perception that has faults, and a node that publishes one goal after the other."""

import functools
import math
import random
from collections.abc import Callable, Sequence

import numpy as np
from geometry_msgs.msg import PoseArray, PoseStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from grader.companions.map_messages import pose_2d, pose_array, pose_stamped
from grader.geometry import Point, Pose2D
from grader.geometry.floor import points_of, thinned
from grader.geometry.near import is_near
from grader.worlds.warehouses import floor_of
from sim.evidence import Seconds, since_start
from sim.world.clearance import clearance

POSE, PEOPLE, OBSTACLES, GOAL = "/robot_pose", "/people", "/obstacles", "/goal_pose"
LASTS = 2.5  # s; each fault, and each person who is not really there
CLOSE, FARTHER = 1.1, 2.0  # m; how far these persons are
ALONE = 2.8  # m; no person is nearer when a fault begins
DRIVES, FAST = 0.8, 0.2  # s and m/s of driving before the next fault
FAULTS = "silent", "stale pose", "stale people", "no people", "close", "farther"


class Localized(Node):
    """Estimates where the robot is, from /odom and where it began."""

    def __init__(self, name: str, seed: int) -> None:
        super().__init__(name)
        self.world = floor_of(seed)
        self.pose = Pose2D(*self.world.start)
        self.speed = 0.0  # m/s
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)

    def on_odom(self, odom: Odometry) -> None:
        """The start looks along x, so the two add up."""
        x, y, yaw = pose_2d(odom.pose.pose)
        self.pose = Pose2D(self.world.start[0] + x, self.world.start[1] + y, yaw)
        self.speed = odom.twist.twist.linear.x


class FaultyPerception(Localized):
    """Perception for the student's control, with the stamps of scans. It knows the warehouse and its boxes.

    Once the robot drives, and no person is near, the next fault comes: it publishes nothing, or the stamps on
    one of the topics no longer change, or it publishes the robot's pose but no people, or it reports a person
    who isn't there, close or not.
    """

    def __init__(self, seed: int) -> None:
        super().__init__("seer", seed)
        draw = random.Random(f"seer {seed}")
        self.faults = draw.sample(FAULTS, len(FAULTS))
        self.fault, self.begin, self.driven = "", 0.0, 0
        self.side = draw.uniform(-math.pi, math.pi)
        self.scans = 0
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.pose_pub = self.create_publisher(PoseStamped, POSE, 10)
        self.people_pub = self.create_publisher(PoseArray, PEOPLE, 10)
        self.obstacles_pub = self.create_publisher(PoseArray, OBSTACLES, 10)

    def on_scan(self, scan: LaserScan) -> None:
        """Publish at every other scan, unless there is a fault."""
        self.scans += 1
        if self.scans % 2:
            return
        people, boxes = self.seen(scan)
        self.change(since_start(scan.header.stamp), people)
        if not self.fault.startswith("stale"):
            self.stamp = scan.header.stamp
        of_pose, of_people = (
            self.stamp if self.fault == f"stale {part}" else scan.header.stamp for part in ("pose", "people")
        )
        if self.fault == "silent":
            return
        if self.fault in ("close", "farther"):
            people = [*people, self.ghost(CLOSE if self.fault == "close" else FARTHER)]
        if self.fault != "no people":
            self.obstacles_pub.publish(pose_array(of_people, [*people, *boxes]))
            self.people_pub.publish(pose_array(of_people, people))
        self.pose_pub.publish(pose_stamped(of_pose, *self.pose))

    def seen(self, scan: LaserScan) -> tuple[list[Sequence[float]], list[Sequence[float]]]:
        """Return points of people, and of boxes that may be pushed."""
        points = points_of(scan, self.pose)
        points = points[clearance(self.world, points[:, 0], points[:, 1]) > 0.15]
        boxes = np.array([(box.x, box.y) for box in self.world.movable])
        near = np.linalg.norm(points[:, None] - boxes[None], axis=2).min(axis=1, initial=math.inf) < 0.5
        return thinned(points[~near].tolist()), thinned(points[near].tolist())

    def ghost(self, away: float) -> Point:
        """Return a point so far (m) from the robot."""
        return self.pose[0] + away * math.cos(self.side), self.pose[1] + away * math.sin(self.side)

    def change(self, now: Seconds, people: list[Sequence[float]]) -> None:
        """Let a fault begin or end, if it is time."""
        if self.fault:
            if now - self.begin >= LASTS:
                self.fault, self.driven = "", 0
            return
        alone = not any(is_near(self.pose[:2], person, ALONE) for person in people)
        self.driven = self.driven + 1 if alone and self.speed > FAST else 0
        if self.faults and self.driven >= DRIVES * 10:
            self.fault, self.begin = self.faults.pop(), now


class GoalCycle(Localized):
    """Decision for the student's control: one place after the other, as soon as the robot stands there."""

    def __init__(self, seed: int) -> None:
        super().__init__("guide", seed)
        self.draw = random.Random(f"guide {seed}")
        self.place = self.next(self.pose[:2])
        self.publisher = self.create_publisher(PoseStamped, GOAL, 10)
        self.create_timer(0.5, self.publish_goal)

    def next(self, here: Point) -> Point:
        """Return a place at a shelf that is neither here nor at the other end."""
        assert self.world.warehouse is not None
        places = [pickup[:2] for pickup in self.world.warehouse.pickups]
        places.sort(key=lambda place: math.dist(here, place))
        return self.draw.choice([place for place in places if not is_near(here, place, 1.0)][:2])

    def publish_goal(self) -> None:
        """Publish where to go now."""
        if math.dist(self.pose[:2], self.place) < 0.1 and abs(self.speed) < 0.02:
            self.place = self.next(self.place)
        self.publisher.publish(pose_stamped(self.get_clock().now().to_msg(), *self.place))


def partners(seed: int) -> list[Callable[[], Node]]:
    """Return perception and decision of a seed, as companions of a run."""
    return [functools.partial(FaultyPerception, seed), functools.partial(GoalCycle, seed)]
