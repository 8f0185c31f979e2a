"""Nodes that drive the robot."""

import math

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Driver(Node):
    """Commands one velocity, ten times a second, from 0.1 s on."""

    v, w = 0.5, 0.0
    kind = Twist

    def __init__(self):
        super().__init__("driver")
        self.publisher = self.create_publisher(self.kind, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = self.v, self.w
        self.publisher.publish(command)


class Turner(Driver):
    v, w = 0.0, 1.0


class Circler(Driver):
    v, w = 0.4, 0.8


class StampedDriver(Driver):
    """The same velocity, with a header."""

    kind = TwistStamped

    def drive(self):
        command = TwistStamped()
        command.header.stamp = self.get_clock().now().to_msg()
        command.twist.linear.x, command.twist.angular.z = self.v, self.w
        self.publisher.publish(command)


class CommandsNoNumber(Driver):
    v, w = math.nan, 0.0


class CommandsInfinity(Driver):
    v, w = 0.1, math.inf


class Flood(Driver):
    """10,000 commands a second."""

    def __init__(self):
        super().__init__()
        self.destroy_timer(next(self.timers))
        self.create_timer(1e-4, self.drive)


class CommandsOnce(Driver):
    """Once, and never again: the robot must stop by itself."""

    def __init__(self):
        super().__init__()
        self.timer = next(self.timers)

    def drive(self):
        super().drive()
        self.timer.cancel()


class Watcher(Node):
    """Receives the sensors, one reliable and one with best effort, and says what their stamps are."""

    def __init__(self):
        super().__init__("watcher")
        self.create_subscription(Odometry, "odom", self.on_odom, 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)

    def say(self, what, header):
        stamp = rclpy.time.Time.from_msg(header.stamp)
        age = (self.get_clock().now() - stamp).nanoseconds
        self.get_logger().info(f"{what} {stamp.nanoseconds} {age}")

    def on_odom(self, odom):
        self.say("odom", odom.header)

    def on_scan(self, scan):
        self.say("scan", scan.header)
