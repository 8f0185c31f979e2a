"""The two programs of the picture at the start of the lesson. At its end you can write both."""

import math
import random

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class HastyDriver(Node):
    """Drives ahead, turns now and then, and looks at nothing."""

    def __init__(self):
        super().__init__("hasty_driver")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.ahead, self.turn = True, 1.0
        self.create_timer(0.1, self.drive)
        self.create_timer(3.0, self.change)

    def change(self):
        """Now ahead, now a turn to one of the sides."""
        self.ahead = not self.ahead
        self.turn = random.choice((-0.8, 0.8))

    def drive(self):
        """Say what to do now."""
        command = Twist()
        command.linear.x = 0.4 if self.ahead else 0.0
        command.angular.z = 0.0 if self.ahead else self.turn
        self.publisher.publish(command)


class Bodyguard(Node):
    """Lets the driver's commands through, but takes the speed out of those that would hit something."""

    def __init__(self):
        super().__init__("bodyguard")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.ahead = 0.0  # meters; nothing is known yet
        self.create_subscription(LaserScan, "/scan", self.look, qos_profile_sensor_data)
        self.create_subscription(Twist, "/cmd_vel_raw", self.filter, 10)

    def look(self, scan):
        """Remember how far the nearest thing ahead is."""
        rays = [*scan.ranges[:35], *scan.ranges[-35:]]
        self.ahead = min((ray for ray in rays if not math.isnan(ray)), default=0.0)

    def filter(self, command):
        """Pass a command on."""
        if self.ahead < 0.5:
            command.linear.x = 0.0
        self.publisher.publish(command)
