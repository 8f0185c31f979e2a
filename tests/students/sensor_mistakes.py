"""Nodes with one mistake each around what sensors say, named by it."""

import numpy as np
from rclpy.node import Node
from sensor_msgs.msg import Imu, LaserScan


class Looker(Node):
    """Looks at a scan and at an IMU's message, and says nothing; nothing is wrong with it."""

    def __init__(self):
        super().__init__("looker")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.look(LaserScan(ranges=[1.0, 2.0]), Imu())

    def look(self, scan, imu):
        return min(scan.ranges) < 1.0 and imu.angular_velocity.z * 0.01


class ComparesAllRanges(Looker):
    def look(self, scan, imu):
        return scan.ranges < 1.0


class AddsUpVectors(Looker):
    def look(self, scan, imu):
        return imu.angular_velocity * 0.01


class LeastOfNothing(Looker):
    def look(self, scan, imu):
        return min(distance for distance in scan.ranges if distance > 3.0)


class LeastOfAnEmptyArray(Looker):
    def look(self, scan, imu):
        ranges = np.array(scan.ranges)
        return ranges[ranges > 3.0].min()
