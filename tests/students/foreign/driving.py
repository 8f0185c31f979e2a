"""Programs that drive the robot, or could: wanderers, multiplexers, scripts, controllers, a behavior tree."""

import dataclasses
import math
import time
from enum import StrEnum, auto

import numpy as np
import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool


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


class Status(StrEnum):
    SUCCESS = auto()
    FAILURE = auto()
    RUNNING = auto()


def sequence(*children):
    """A node of a behavior tree: each child in turn, until one doesn't succeed."""

    def tick():
        return next(
            (status for child in children if (status := child()) is not Status.SUCCESS), Status.SUCCESS
        )

    return tick


def fallback(*children):
    def tick():
        return next(
            (status for child in children if (status := child()) is not Status.FAILURE), Status.FAILURE
        )

    return tick


class Patrols(Node):
    """A behavior tree ticks at 10 Hz: turn away from what is near, else drive."""

    def __init__(self):
        super().__init__("patrols")
        self.near = math.inf
        self.command = Twist()
        self.drives = self.create_publisher(Twist, "cmd_vel", 1)
        self.create_subscription(LaserScan, "scan", self.look, qos_profile_sensor_data)
        self.tree = sequence(self.has_scan, fallback(sequence(self.is_free, self.go), self.turn))
        self.create_timer(0.1, self.tick)

    def look(self, scan):
        ahead = np.roll(np.asarray(scan.ranges), 30)[:60]
        self.near = float(np.nanmin(np.where(np.isfinite(ahead), ahead, scan.range_max)))

    def has_scan(self):
        return Status.SUCCESS if math.isfinite(self.near) else Status.FAILURE

    def is_free(self):
        return Status.SUCCESS if self.near > 0.6 else Status.FAILURE

    def go(self):
        self.command = Twist()
        self.command.linear.x = 0.2
        return Status.SUCCESS

    def turn(self):
        self.command = Twist()
        self.command.angular.z = 0.5
        return Status.RUNNING

    def tick(self):
        if self.tree() is not Status.FAILURE:
            self.drives.publish(self.command)


@dataclasses.dataclass
class Pid:
    """A controller in plain Python."""

    kp: float
    ki: float = 0.0
    limit: float = 1.0
    total: float = 0.0

    def __call__(self, error: float, dt: float) -> float:
        self.total += error * dt
        return max(-self.limit, min(self.limit, self.kp * error + self.ki * self.total))


class Cascade(Node):
    """Two controllers, one inside the other; a service switches them off, and each stop is sent."""

    def __init__(self):
        super().__init__("cascade")
        self.position, self.speed = Pid(0.8, limit=0.3), Pid(1.5, 0.2, limit=0.3)
        self.state, self.enabled = None, True
        self.drives = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_subscription(Odometry, "odom", lambda message: setattr(self, "state", message), 10)
        self.create_service(SetBool, "enable", self.enable)
        self.create_timer(1 / 20, self.control)

    def enable(self, request, response):
        self.enabled, response.success = request.data, True
        return response

    def control(self):
        command = Twist()
        if self.enabled and self.state is not None:
            wanted = self.position(0.4 - self.state.pose.pose.position.x, 0.05)
            command.linear.x = self.speed(wanted - self.state.twist.twist.linear.x, 0.05)
        self.drives.publish(command)


CORPUS = [
    (Wanders,),
    (Multiplexer, Navigates),
    (Multiplexer,),
    (FiltersOdometry,),
    (LeftWheel, RightWheel),
    (CameraA, TakesCameraB),
    (stops_at_its_end,),
    (Keeps,),
    (Patrols,),
    (Cascade,),
]
