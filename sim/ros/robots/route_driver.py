"""Drives another robot of a world along its route, by its odometry and lidar only."""

from __future__ import annotations

import math

from geometry_msgs.msg import Point, Quaternion
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

from sim.ros.robots.velocity import VelocityPublisher
from sim.world import LidarModel, OtherRobot, RobotModel, Route
from sim.world.robot import wrap

LOOKAHEAD = 0.25  # m; it steers for the point of the route at this distance
STOP_DISTANCE = 0.5  # m; an obstacle on the route within this distance stops it
MARGIN = 0.05  # m; free space required beside the robot
MAX_COORDINATE = 1e6  # m; larger than any world
STEERING_GAIN = 3.0  # rad/s per rad of heading error


class RouteDriver(Node):
    """Drives along a route at a given speed, and waits while an obstacle is on it.

    In the robot's namespace it subscribes to odom and scan, and publishes a cmd_vel for each odom.
    """

    def __init__(self, robot: OtherRobot, model: RobotModel, lidar: LidarModel) -> None:
        super().__init__("driver", namespace=robot.name, start_parameter_services=False)
        self.speed, self.start, self.width = robot.speed, robot.start, model.radius + MARGIN
        self.first_look, self.lidar = model.radius, lidar
        self.route = Route(robot.route)
        self.place = self.route.nearest(*robot.start[:2])
        self.near: list[tuple[float, float]] = []  # bearing (rad) and distance (m), from the lidar
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, 10)
        self.velocity = VelocityPublisher(self, model.stamped)

    def on_scan(self, scan: LaserScan) -> None:
        """Store near hits; -inf is nearer than the lidar measures, inf and nan are no hits (REP-117)."""
        if not all(map(math.isfinite, (scan.angle_min, scan.angle_increment, scan.range_min))):
            return
        reach = STOP_DISTANCE + self.width
        self.near = [
            (scan.angle_min + ray * scan.angle_increment, max(distance, scan.range_min))
            for ray, distance in enumerate(scan.ranges)
            if distance < reach
        ]

    def on_odom(self, odom: Odometry) -> None:
        """Steer for the route from where the robot is."""
        position, turn = odom.pose.pose.position, odom.pose.pose.orientation
        if not all(abs(number) < MAX_COORDINATE for number in (position.x, position.y, turn.z, turn.w)):
            return  # invalid: any node may publish here
        x, y, yaw = self.in_map(position, turn)
        self.place = self.route.nearest(x, y, self.place, LOOKAHEAD) % self.route.length
        forward = left = 0.0
        if not self.is_blocked(x, y, yaw):
            ahead_x, ahead_y = self.route.point(self.place + LOOKAHEAD)
            off = wrap(math.atan2(ahead_y - y, ahead_x - x) - yaw)
            forward, left = self.speed * max(math.cos(off), 0.0), STEERING_GAIN * off
        self.velocity.send(forward, left)

    def in_map(self, position: Point, turn: Quaternion) -> tuple[float, float, float]:
        """The robot's pose in the map frame, from its start pose and odometry."""
        x0, y0, yaw0 = self.start
        c, s = math.cos(yaw0), math.sin(yaw0)
        x, y = x0 + c * position.x - s * position.y, y0 + s * position.x + c * position.y
        return x, y, wrap(yaw0 + 2 * math.atan2(turn.z, turn.w))

    def is_blocked(self, x: float, y: float, yaw: float) -> bool:
        """Return whether an obstacle is on the next stretch of the route."""
        if not self.near:
            return False
        steps = math.ceil((STOP_DISTANCE - self.first_look) / self.width * 2)
        stretch = (STOP_DISTANCE - self.first_look) / steps
        eye_x, eye_y, turn = self.lidar.mounted_at((x, y, yaw))
        path = [self.route.point(self.place + self.first_look + step * stretch) for step in range(steps + 1)]
        for bearing, distance in self.near:
            angle = turn + bearing
            hit_x, hit_y = eye_x + distance * math.cos(angle), eye_y + distance * math.sin(angle)
            if any(math.hypot(hit_x - path_x, hit_y - path_y) < self.width for path_x, path_y in path):
                return True
        return False
