"""Perceptions of a delivery robot: right ones, and wrong ones named by their defect."""

import math

import rclpy
from geometry_msgs.msg import PoseArray, PoseStamped
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_ros import Buffer, TransformException, TransformListener

from grader.exercises.delivery import (
    LATCHED,
    Floor,
    away_from,
    points_of,
    pose_array,
    pose_stamped,
    seconds,
)


class Perception(Node):
    """As one would write it; the wrong ones change one thing each."""

    map_profile, frame, keeps, every = LATCHED, "base_link", 5.0, 2

    def __init__(self):
        super().__init__("perception")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.floor, self.seen, self.walked, self.scans = None, [], [], 0
        self.start = self.get_clock().now().nanoseconds / 1e9
        self.create_subscription(OccupancyGrid, "/map", self.on_map, self.map_profile)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.pose_pub = self.create_publisher(PoseStamped, "/robot_pose", 10)
        self.people_pub = self.create_publisher(PoseArray, "/people", 10)
        self.obstacles_pub = self.create_publisher(PoseArray, "/obstacles", 10)

    def on_map(self, grid):
        self.floor = Floor(grid)

    def place(self, frame, stamp):
        there = self.buffer.lookup_transform("map", frame, stamp).transform
        return there.translation.x, there.translation.y, 2 * math.atan2(there.rotation.z, there.rotation.w)

    def on_scan(self, scan):
        self.scans += 1
        if self.floor is None or self.scans % self.every:
            return
        try:
            robot, lidar = self.place(self.frame, scan.header.stamp), self.lidar(scan.header.stamp)
        except TransformException:
            return
        strange = self.strange(points_of(scan, lidar))
        self.tell(self.stamp(scan), robot, strange)

    def lidar(self, stamp):
        return self.place("base_scan", stamp)

    def strange(self, points):
        return self.floor.strange(points)

    def stamp(self, scan):
        return scan.header.stamp

    def moved(self, now, strange):
        before = [points for when, points in self.seen if now - when > 0.4]
        self.seen = [*((when, points) for when, points in self.seen if now - when < 2.0), (now, strange)]
        return away_from(strange, before[-1] if before else [], 0.25)

    def tell(self, stamp, robot, strange):
        now = seconds(stamp)
        moved = self.moved(now, strange)
        self.walked = [(when, point) for when, point in self.walked if now - when < self.keeps]
        self.walked += [(now, point) for point in moved]
        self.obstacles_pub.publish(pose_array(stamp, strange))
        self.people_pub.publish(pose_array(stamp, self.people()))
        self.pose_pub.publish(self.pose(stamp, robot))

    def people(self):
        return away_from([point for _, point in self.walked], [], 0.0)

    def pose(self, stamp, robot):
        return pose_stamped(stamp, *robot)


class ForgetsWhereSomeoneWalksNow(Perception):
    """As in the lesson: an old point near a new one goes."""

    def moved(self, now, strange):
        moved = super().moved(now, strange)
        self.walked = [(when, point) for when, point in self.walked if away_from([point], moved, 0.2)]
        return moved


class KeepsLonger(Perception):
    """A design of its own: a second more, and another half second for comparison."""

    keeps = 5.4

    def moved(self, now, strange):
        before = [points for when, points in self.seen if now - when > 0.55]
        self.seen = [*((when, points) for when, points in self.seen if now - when < 2.0), (now, strange)]
        return away_from(strange, before[-1] if before else [], 0.3)


def main():
    rclpy.init()
    rclpy.spin(Perception())


class PlaceOfTheLidar(Perception):
    """As in the lesson: where the lidar is."""

    frame = "base_scan"


class LidarInTheMiddle(Perception):
    """Rays from base_link."""

    def lidar(self, stamp):
        return self.place("base_link", stamp)


class StampsOfNow(Perception):
    """Stale data look fresh."""

    def stamp(self, scan):
        return self.get_clock().now().to_msg()


class FrameOfTheLidar(Perception):
    """The place is that in map, and its header says otherwise."""

    def pose(self, stamp, robot):
        pose = super().pose(stamp, robot)
        pose.header.frame_id = "base_scan"
        return pose


class EverySixthScan(Perception):
    """Three in a second: it saves work."""

    every = 6


class DrawsDiscs(Perception):
    """Around each point of someone, as a person is wider than a point."""

    def people(self):
        angles = [math.tau * part / 24 for part in range(24)]
        round_ = [(0.1 * math.cos(angle), 0.1 * math.sin(angle)) for angle in angles]
        return [(x + dx, y + dy) for x, y in super().people() for dx, dy in round_]


class AllIsStrange(Perception):
    """What is on the map, too."""

    def strange(self, points):
        return points[::4].tolist()


class NothingIsStrange(Perception):
    """An empty list."""

    def strange(self, points):
        return []


class EverythingWalks(Perception):
    """In doubt on the safe side."""

    def moved(self, now, strange):
        return strange


class EverythingWalksLater(EverythingWalks):
    """The same, once there has been time to look."""

    def tell(self, stamp, robot, strange):
        if seconds(stamp) - self.start > 5.0:
            super().tell(stamp, robot, strange)


class NoOneWalks(Perception):
    """Boxes all of them."""

    def moved(self, now, strange):
        return []


class ForgetsAtOnce(Perception):
    """People are reported while they walk."""

    keeps = 0.5


class KeepsForAMoment(Perception):
    """What moved is forgotten after a moment."""

    keeps = 0.05

    def moved(self, now, strange):
        return super().moved(now, strange)[::7]


class ComparesWithTheLastScan(Perception):
    """A tenth of a second isn't enough to move by 25 cm."""

    def moved(self, now, strange):
        before, self.seen = self.seen, strange
        return away_from(strange, before, 0.25)


class MapTooLate(Perception):
    """Subscribes to the map as to any other topic."""

    map_profile = 10


class ObstaclesEverywhere(Perception):
    """Every free place of the map is an obstacle."""

    def strange(self, points):
        grid, rows = self.floor, self.floor.known[::4, ::4]
        free = [
            (grid.left + 4 * column * grid.info.resolution, grid.bottom + 4 * row * grid.info.resolution)
            for row, cells in enumerate(rows) for column, near in enumerate(cells) if not near
        ]  # fmt: skip
        return [*super().strange(points), *free]

    def moved(self, now, strange):
        return super().moved(now, [])


class PeopleEverywhere(Perception):
    """A person may be anywhere around the robot."""

    def tell(self, stamp, robot, strange):
        self.robot = robot
        super().tell(stamp, robot, strange)

    def people(self):
        steps = [0.5 * step for step in range(-7, 8)]
        return [(self.robot[0] + dx, self.robot[1] + dy) for dx in steps for dy in steps]


class PoseOfNow(Perception):
    """Looks up where the robot is, not where it was when the scan was made."""

    def place(self, frame, stamp):
        return super().place(frame, Time())
