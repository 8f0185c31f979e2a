"""The student's program of the benchmarks: drives about, and turns where the lidar sees something near."""

import math

import rclpy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class Avoider(Node):
    """Receives /scan and /odom at 20 Hz, sends /cmd_vel at 10 Hz."""

    def __init__(self):
        super().__init__("avoider")
        self.nearest, self.traveled, self.last = math.inf, 0.0, None
        self.scans = self.odoms = self.commands = 0  # for the benchmark's comparison
        self.create_subscription(LaserScan, "scan", self.on_scan, 10)
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def on_scan(self, scan):
        """Remember how near the nearest thing within 45 degrees of straight ahead is."""
        self.scans += 1
        self.nearest = min(min(scan.ranges[:45]), min(scan.ranges[-45:]))

    def on_odom(self, odom):
        """Add up the distance."""
        self.odoms += 1
        here = odom.pose.pose.position.x, odom.pose.pose.position.y
        self.traveled += math.dist(here, self.last or here)
        self.last = here

    def drive(self):
        """Straight on, or turn on the spot."""
        self.commands += 1
        command = Twist()
        if self.nearest < 0.6:
            command.angular.z = 1.0
        else:
            command.linear.x = 0.4
        self.publisher.publish(command)


def main():
    """As a tutorial writes it."""
    rclpy.init()
    node = Avoider()
    try:
        rclpy.spin(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()
