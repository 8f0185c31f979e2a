"""Perception: where is the robot, what stands near it, and who walks?"""

import math

import numpy as np
from geometry_msgs.msg import Pose, PoseArray, PoseStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from tests.bench.delivery.floor import KEPT, near, wrapped, yaw_of

BESIDE = 0.35  # m: the sides of a box, of which a scan may miss the rays between them


class Thing:
    """What the lidar sees and the map doesn't show: where it is, and when it last moved."""

    def __init__(self, x, y, now):
        self.x, self.y, self.seen, self.born = x, y, now, now
        self.anchor, self.moved = (x, y), -math.inf

    def see(self, x, y, now):
        self.x, self.y, self.seen = x, y, now
        if math.dist(self.anchor, (x, y)) > 0.3:
            self.anchor, self.moved = (x, y), now

    def may_walk(self, now):
        """What walked a moment ago is a person, and what is new may be one."""
        return now - self.moved < 6.0 or now - self.born < 3.0


class Perception(Node):
    """Says where the robot is on the map, and what is near that the map doesn't show.

    Publishes /robot_pose, /people (who walks, or may) and /obstacles (points of what stands), all in map.
    """

    def __init__(self):
        super().__init__("perception")
        self.map_to_odom = self.odom = self.known = None
        self.things, self.scans = [], 0
        self.create_subscription(OccupancyGrid, "/map", self.on_map, KEPT)
        self.create_subscription(TFMessage, "/tf_static", self.on_tf_static, KEPT)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "/scan", self.on_scan, qos_profile_sensor_data)
        self.pose_pub = self.create_publisher(PoseStamped, "/robot_pose", 10)
        self.people_pub = self.create_publisher(PoseArray, "/people", 10)
        self.obstacles_pub = self.create_publisher(PoseArray, "/obstacles", 10)

    def on_map(self, grid):
        """What lies this near to something on the map, 0.15 m, is that."""
        self.info = grid.info
        cells = np.array(grid.data, dtype=np.int8).reshape(grid.info.height, grid.info.width)
        self.known = near(cells > 50, round(0.15 / grid.info.resolution))

    def on_tf_static(self, message):
        for transform in message.transforms:
            if (transform.header.frame_id, transform.child_frame_id) == ("map", "odom"):
                move = transform.transform
                self.map_to_odom = move.translation.x, move.translation.y, yaw_of(move.rotation)

    def on_odom(self, odom):
        self.odom = odom

    def locate(self):
        """Where the robot is on the map, by its odometry."""
        x0, y0, yaw0 = self.map_to_odom
        place = self.odom.pose.pose
        x, y, yaw = place.position.x, place.position.y, yaw_of(place.orientation)
        c, s = math.cos(yaw0), math.sin(yaw0)
        return x0 + c * x - s * y, y0 + s * x + c * y, wrapped(yaw0 + yaw)

    def on_scan(self, scan):
        self.scans += 1
        if self.map_to_odom is None or self.odom is None or self.known is None or self.scans % 2:
            return  # ten scans a second are enough
        now = Time.from_msg(scan.header.stamp).nanoseconds / 1e9
        self.pose = self.locate()
        groups = self.groups(self.unknown(scan))
        for group in groups:
            self.remember(*np.mean(group, axis=0), now)
        self.things = [thing for thing in self.things if now - thing.seen < 1.0]
        walking = [thing for thing in self.things if thing.may_walk(now)]
        self.tell(self.people_pub, scan.header.stamp, [(thing.x, thing.y) for thing in walking])
        if self.scans % 10 == 0:
            standing = [point for group in groups for point in group]
            self.tell(self.obstacles_pub, scan.header.stamp, standing)
        message = PoseStamped()
        message.header.stamp, message.header.frame_id = scan.header.stamp, "map"
        message.pose.position.x, message.pose.position.y = self.pose[:2]
        message.pose.orientation.z = math.sin(self.pose[2] / 2)
        message.pose.orientation.w = math.cos(self.pose[2] / 2)
        self.pose_pub.publish(message)

    def unknown(self, scan):
        """The points, in map, where rays met what is not on the map."""
        ranges = np.array(scan.ranges)
        rays = np.flatnonzero(np.isfinite(ranges))
        x, y, yaw = self.pose
        angles = yaw + scan.angle_min + rays * scan.angle_increment
        points = np.column_stack((x + ranges[rays] * np.cos(angles), y + ranges[rays] * np.sin(angles)))
        origin, size = self.info.origin.position, self.info.resolution
        column = ((points[:, 0] - origin.x) / size).astype(int).clip(0, self.info.width - 1)
        row = ((points[:, 1] - origin.y) / size).astype(int).clip(0, self.info.height - 1)
        return points[~self.known[row, column]].tolist()

    def groups(self, points):
        """Points that lie beside each other belong to one thing."""
        groups = []
        for point in points:
            if groups and math.dist(groups[-1][-1], point) < BESIDE:
                groups[-1].append(point)
            else:
                groups.append([point])
        if len(groups) > 1 and math.dist(groups[0][0], groups[-1][-1]) < BESIDE:
            groups[0] = groups.pop() + groups[0]  # the first ray is beside the last
        return groups

    def remember(self, x, y, now):
        """Find out which thing this is: the nearest one, or a new one."""
        others = [thing for thing in self.things if thing.seen < now]  # a box may be two groups of a scan
        thing = min(others, key=lambda thing: math.dist((thing.x, thing.y), (x, y)), default=None)
        if thing is not None and math.dist((thing.x, thing.y), (x, y)) < 0.3:
            thing.see(x, y, now)
        else:
            self.things.append(Thing(x, y, now))

    def tell(self, publisher, stamp, points):
        message = PoseArray()
        message.header.stamp, message.header.frame_id = stamp, "map"
        for x, y in points:
            pose = Pose()
            pose.position.x, pose.position.y = float(x), float(y)
            message.poses.append(pose)
        publisher.publish(message)
