"""Drives another robot of a world round its route, as any node would: by what the robot hears and sees."""

from __future__ import annotations

import math

from geometry_msgs.msg import Point, Quaternion
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

from sim.ros.robots.velocity import VelocityPublisher
from sim.world import LidarModel, OtherRobot, RobotModel, Route
from sim.world.robot import wrap

AHEAD = 0.25  # m; it steers for the point of the route this far ahead
LOOKS = 0.5  # m; what lies on the route up to here stops it
GAP = 0.05  # m; what is as near as this to the way of its rim is in the way
FAR = 1e6  # m; farther away than any world reaches
STEER = 3.0  # rad/s for each rad that the point ahead is off


class RouteDriver(Node):
    """Drives round a route at a given speed, and waits while something stands on it.

    In the robot's namespace it hears odom and scan, and answers each odom with a cmd_vel.
    """

    def __init__(self, robot: OtherRobot, model: RobotModel, lidar: LidarModel) -> None:
        super().__init__("driver", namespace=robot.name, start_parameter_services=False)
        self.speed, self.start, self.width = robot.speed, robot.start, model.radius + GAP
        self.first_look, self.lidar = model.radius, lidar
        self.route = Route(robot.route)
        self.place = self.route.nearest(*robot.start[:2])
        self.near: list[tuple[float, float]] = []  # bearing (rad) and distance (m), from the lidar
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, 10)
        self.velocity = VelocityPublisher(self, model.stamped)

    def on_scan(self, scan: LaserScan) -> None:
        """Keep what is near; -inf is nearer than the lidar can measure, inf and nan are nothing (REP-117)."""
        if not all(map(math.isfinite, (scan.angle_min, scan.angle_increment, scan.range_min))):
            return
        reach = LOOKS + self.width
        self.near = [
            (scan.angle_min + ray * scan.angle_increment, max(distance, scan.range_min))
            for ray, distance in enumerate(scan.ranges)
            if distance < reach
        ]

    def on_odom(self, odom: Odometry) -> None:
        """Steer for the route from where the robot is."""
        position, turn = odom.pose.pose.position, odom.pose.pose.orientation
        if not all(abs(number) < FAR for number in (position.x, position.y, turn.z, turn.w)):
            return  # not a number, or not of this world: anybody may publish here
        x, y, yaw = self.in_map(position, turn)
        self.place = self.route.nearest(x, y, self.place, AHEAD) % self.route.length
        forward = left = 0.0
        if not self.blocked(x, y, yaw):
            ahead_x, ahead_y = self.route.point(self.place + AHEAD)
            off = wrap(math.atan2(ahead_y - y, ahead_x - x) - yaw)
            forward, left = self.speed * max(math.cos(off), 0.0), STEER * off
        self.velocity.send(forward, left)

    def in_map(self, position: Point, turn: Quaternion) -> tuple[float, float, float]:
        """Where the robot is in the map frame: it knows where it started."""
        x0, y0, yaw0 = self.start
        c, s = math.cos(yaw0), math.sin(yaw0)
        x, y = x0 + c * position.x - s * position.y, y0 + s * position.x + c * position.y
        return x, y, wrap(yaw0 + 2 * math.atan2(turn.z, turn.w))

    def blocked(self, x: float, y: float, yaw: float) -> bool:
        """Whether something is on the stretch of the route that comes next."""
        if not self.near:
            return False
        steps = math.ceil((LOOKS - self.first_look) / self.width * 2)
        stretch = (LOOKS - self.first_look) / steps
        eye_x, eye_y, turn = self.lidar.mounted_at((x, y, yaw))
        way = [self.route.point(self.place + self.first_look + step * stretch) for step in range(steps + 1)]
        for bearing, distance in self.near:
            angle = turn + bearing
            hit_x, hit_y = eye_x + distance * math.cos(angle), eye_y + distance * math.sin(angle)
            if any(math.hypot(hit_x - way_x, hit_y - way_y) < self.width for way_x, way_y in way):
                return True
        return False
