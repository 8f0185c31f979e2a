"""Programs that drive the robot, or could: wanderers, multiplexers, scripts, controllers."""

import math
import time

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64, String


class Wanders(Node):
    def __init__(self):
        super().__init__("wanders")
        self.near = math.inf
        self.create_subscription(LaserScan, "/scan", self.scan, 10)
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.tick)

    def scan(self, message):
        self.near = min(message.ranges[:10] + message.ranges[-10:])

    def tick(self):
        twist = Twist()
        if self.near < 0.6:
            twist.angular.z = 0.8
        else:
            twist.linear.x = 0.2
        self.publisher.publish(twist)


class Multiplexer(Node):
    """Passes on what one of two others sends; the second is not there."""

    def __init__(self):
        super().__init__("multiplexer")
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_subscription(Twist, "/teleop/cmd_vel", self.publisher.publish, 10)
        self.create_subscription(Twist, "/nav/cmd_vel", lambda message: self.publisher.publish(message), 10)


class Navigates(Node):
    def __init__(self):
        super().__init__("nav", namespace="nav")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(Twist()))


class FiltersOdometry(Node):
    """Its input and its output have nearly the same name."""

    def __init__(self):
        super().__init__("filter")
        self.publisher = self.create_publisher(Odometry, "/odom_filtered", 10)
        self.create_subscription(Odometry, "/odom", self.publisher.publish, 10)


class LeftWheel(Node):
    def __init__(self):
        super().__init__("left_wheel")
        self.publisher = self.create_publisher(Float64, "left_wheel/command", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(Float64()))


class RightWheel(Node):
    def __init__(self):
        super().__init__("right_wheel")
        self.create_subscription(Float64, "right_wheel/command", lambda _: None, 10)


class CameraA(Node):
    def __init__(self):
        super().__init__("camera_a")
        self.publisher = self.create_publisher(String, "camera_a/image", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(String()))


class TakesCameraB(Node):
    def __init__(self):
        super().__init__("viewer")
        self.create_subscription(String, "camera_b/image", lambda _: None, 10)


def stops_at_its_end():
    """Drives for two seconds, and stops the robot whatever happens."""
    rclpy.init()
    node = rclpy.create_node("script")
    publisher = node.create_publisher(Twist, "/cmd_vel", 10)
    twist = Twist()
    twist.linear.x = 0.1
    try:
        for _ in range(20):
            publisher.publish(twist)
            time.sleep(0.1)
    finally:
        publisher.publish(Twist())
        node.destroy_node()
        rclpy.shutdown()


class Keeps(Node):
    """Turns towards a heading, and publishes where it is."""

    def __init__(self):
        super().__init__("keeps")
        self.declare_parameter("heading", 0.5)
        self.command = self.create_publisher(Twist, "/cmd_vel", 10)
        self.pose = self.create_publisher(PoseStamped, "pose", 10)
        self.create_subscription(Odometry, "/odom", self.odom, 10)

    def odom(self, message):
        self.pose.publish(PoseStamped(header=message.header, pose=message.pose.pose))
        turned = message.pose.pose.orientation
        error = self.get_parameter("heading").value - 2.0 * math.atan2(turned.z, turned.w)
        twist = Twist()
        twist.angular.z = 1.5 * math.atan2(math.sin(error), math.cos(error))
        self.command.publish(twist)


CORPUS = [
    (Wanders,),
    (Multiplexer, Navigates),
    (Multiplexer,),
    (FiltersOdometry,),
    (LeftWheel, RightWheel),
    (CameraA, TakesCameraB),
    (stops_at_its_end,),
    (Keeps,),
]
