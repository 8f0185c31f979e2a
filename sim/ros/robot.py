"""The simulated robot as an ordinary ROS 2 node: commands in, sensors out."""

from __future__ import annotations

import array
import math

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import TransformStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Bool
from tf2_msgs.msg import TFMessage

from sim.recording import Pose, Recording
from sim.world import CommandError, Simulation

SENSOR_RATE = 20.0  # Hz
BASE, ODOM = "base_link", "odom"
WHEELS = ["wheel_left_joint", "wheel_right_joint"]


class Robot(Node):
    """A differential-drive robot with a 360-ray lidar and a bumper.

    Subscribes /cmd_vel (geometry_msgs/Twist: linear.x m/s, angular.z rad/s; others are ignored). Publishes
    at 20 Hz /odom, /scan, /joint_states, /tf (odom -> base_link), /bumper (std_msgs/Bool) and /clock, all
    reliable, which best-effort subscriptions can hear too. /odom starts at zero where the robot starts; the
    lidar sits at base_link's origin.
    """

    def __init__(self, simulation: Simulation, recording: Recording) -> None:
        super().__init__("robot", start_parameter_services=False)
        self.simulation, self.recording = simulation, recording
        self.create_subscription(Twist, "cmd_vel", self.on_cmd_vel, 10)
        self.clock_pub = self.create_publisher(Clock, "/clock", 1)
        self.odom_pub = self.create_publisher(Odometry, "odom", 10)
        self.scan_pub = self.create_publisher(LaserScan, "scan", 10)
        self.joint_pub = self.create_publisher(JointState, "joint_states", 10)
        self.tf_pub = self.create_publisher(TFMessage, "/tf", 100)
        self.bumper_pub = self.create_publisher(Bool, "bumper", 10)
        self._make_messages()
        self.sense()
        self.create_timer(1.0 / SENSOR_RATE, self.sense)

    def _make_messages(self) -> None:
        """The messages are made once: only what changes is written at 20 Hz."""
        lidar = self.simulation.lidar
        self.clock, self.odom, self.scan = Clock(), Odometry(), LaserScan()
        self.transform, self.joints, self.bumper = TransformStamped(), JointState(name=WHEELS), Bool()
        self.odom.header.frame_id = self.transform.header.frame_id = ODOM
        self.odom.child_frame_id = self.transform.child_frame_id = BASE
        self.scan.header.frame_id = BASE
        self.scan.angle_min, self.scan.angle_max = 0.0, 2 * math.pi * (1 - 1 / lidar.rays)
        self.scan.angle_increment = 2 * math.pi / lidar.rays
        self.scan.scan_time = 1 / SENSOR_RATE
        self.scan.range_min, self.scan.range_max = lidar.range_min, lidar.range_max
        self.tf = TFMessage(transforms=[self.transform])

    def _now(self) -> tuple[float, Time]:
        now = self.get_clock().now()
        return now.nanoseconds / 1e9, now.to_msg()

    def on_cmd_vel(self, command: Twist) -> None:
        """Drive on to now with the old command, then take the new one."""
        self.simulation.advance(self._now()[0])
        try:
            self.simulation.command(command.linear.x, command.angular.z)
        except CommandError as error:
            self.get_logger().error(str(error), throttle_duration_sec=1.0)

    def sense(self) -> None:
        """Move the world to now and publish what the sensors see."""
        now, stamp = self._now()
        self.simulation.advance(now)
        self._remember(now)
        self.clock.clock = stamp
        self.clock_pub.publish(self.clock)
        self._publish_odometry(stamp)
        self.scan.header.stamp = stamp
        self.scan.ranges = array.array(
            "f", np.ascontiguousarray(self.simulation.scan(), dtype=np.float32).tobytes()
        )
        self.scan_pub.publish(self.scan)
        self.bumper.data = bool(self.simulation.bumper)
        self.bumper_pub.publish(self.bumper)

    def _publish_odometry(self, stamp: Time) -> None:
        x, y, yaw, v, w = self.simulation.odometry
        odom, transform, joints = self.odom, self.transform, self.joints
        odom.header.stamp = transform.header.stamp = joints.header.stamp = stamp
        pose, twist, move = odom.pose.pose, odom.twist.twist, transform.transform
        pose.position.x, pose.position.y = move.translation.x, move.translation.y = x, y
        pose.orientation.z = move.rotation.z = math.sin(yaw / 2)
        pose.orientation.w = move.rotation.w = math.cos(yaw / 2)
        twist.linear.x, twist.angular.z = v, w
        wheels = self.simulation.wheels
        joints.position, joints.velocity = [wheels.left, wheels.right], [wheels.left_rate, wheels.right_rate]
        self.odom_pub.publish(odom)
        self.tf_pub.publish(self.tf)
        self.joint_pub.publish(joints)

    def _remember(self, now: float) -> None:
        self.recording.path.append(Pose(now, *self.simulation.pose))
        self.recording.contacts = self.simulation.contacts
