"""The program that drives at the end of the lesson. Lessons 1 and 2 explain every line of it."""

import math

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Explorer(Node):
    """Drives ahead and turns left when the lidar sees something near."""

    def __init__(self):
        super().__init__("explorer")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(LaserScan, "/scan", self.look, qos_profile_sensor_data)

    def look(self, scan):
        """Choose a velocity, 20 times a second."""
        ahead = [*scan.ranges[-40:], *scan.ranges[:40]]
        near = min((r for r in ahead if not math.isnan(r)), default=math.inf) < 0.6
        command = Twist()
        command.linear.x = 0.0 if near else 0.4
        command.angular.z = 1.0 if near else 0.0
        self.publisher.publish(command)
