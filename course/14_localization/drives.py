"""What lesson 14b drives with: a robot on a slippery floor, and a driver who looks at nothing."""

import collections
import math
from dataclasses import replace

import numpy as np
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node

from sim import World
from sim.evidence import Recording
from sim.world import ImuModel, WheelModel


class Tour(Node):
    """Drives legs of 3 s and turns of 1.5 s to one side: a wide loop. It rests for the first second."""

    def __init__(self, speed=0.35, turn=0.7, side=1.0):
        super().__init__("tour")
        self.speed, self.turn, self.side, self.ticks = speed, turn, side, 0
        self.publisher = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        """Publish the command of this moment."""
        self.ticks += 1
        command, phase = Twist(), (self.ticks - 10) % 45
        if self.ticks > 10:
            command.linear.x = self.speed
            command.angular.z = self.side * self.turn if phase >= 30 else 0.0
        self.publisher.publish(command)


class SlowBoard(Node):
    """Publishes each message of /odom again on /odom_slow, 0.4 s later: a computer that is slow."""

    def __init__(self):
        super().__init__("slow_board")
        self.waiting = collections.deque()
        self.publisher = self.create_publisher(Odometry, "/odom_slow", 10)
        self.create_subscription(Odometry, "/odom", self.on_odom, 10)
        self.create_timer(0.05, self.publish)

    def on_odom(self, msg):
        """Keep a message."""
        self.waiting.append(msg)

    def publish(self):
        """Publish the oldest message, once eight newer ones have arrived."""
        while len(self.waiting) > 8:
            self.publisher.publish(self.waiting.popleft())


def slippery(slip=0.007, bias=0.05, noise=0.01, **wheels):
    """An empty yard for a robot whose wheels slip, and whose gyro has a bias."""
    imu = ImuModel(rate=20, gyro_noise=noise, gyro_bias=bias)
    yard = World.load("yard")
    return replace(yard, wheels=WheelModel(slip=slip, **wheels), imu=imu, lidar=replace(yard.lidar, rays=1))


def yaw_of(pose):
    """The yaw of a message's pose, in radians."""
    return 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def error(recording: Recording, topic: str) -> np.ndarray:
    """What must be added to the last x, y and yaw on a topic to get the true ones; m and rad."""
    pose, true = recording.messages(topic)[-1].message.pose.pose, recording.path[-1]
    off = true.x - pose.position.x, true.y - pose.position.y, true.yaw - yaw_of(pose)
    return np.array([*off[:2], math.remainder(off[2], math.tau)])


def covariance(recording: Recording, topic: str) -> np.ndarray:
    """The last covariance of x, y and yaw on a topic, as a matrix."""
    numbers = recording.messages(topic)[-1].message.pose.covariance
    return np.reshape(numbers, (6, 6))[np.ix_((0, 1, 5), (0, 1, 5))]
