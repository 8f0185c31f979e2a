"""A simulated robot as an ordinary ROS 2 node: commands in, sensors out."""

from __future__ import annotations

import math
from collections import deque

from geometry_msgs.msg import TransformStamped, Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Bool, Header
from tf2_msgs.msg import TFMessage

from sim.nanoseconds import SECOND
from sim.ros.robots.battery_topic import BatteryTopic
from sim.ros.robots.imu_topic import ImuTopic
from sim.ros.robots.rates import MAX_COMMAND_RATE, SENSOR_RATE
from sim.ros.robots.sensor_messages import SensorMessages
from sim.world import CommandError, MobileRobot, World

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Robot(Node):
    """A differential-drive robot with a lidar, a bumper and, where the world says so, an IMU and a battery.

    Subscribes cmd_vel (geometry_msgs/Twist: linear.x m/s, angular.z rad/s; others are ignored), which is
    geometry_msgs/TwistStamped where the world says so; its stamp and frame are ignored.
    Publishes at 20 Hz odom, scan, joint_states, bumper (std_msgs/Bool) and /tf (odom -> base_link), and
    imu/data at the IMU's rate, and battery_state at 1 Hz; all reliable, which also matches best-effort
    subscriptions. odom starts at zero where the robot starts; the IMU is at base_link's origin, and the lidar
    at base_scan, whose transform (base_link -> base_scan) is published once on /tf_static, latched.

    The world's first robot is in the root namespace, and publishes /clock. Every other robot has its name as
    namespace and as prefix of its frames.

    The run advances the world: `robot` has its state at the node's time.
    """

    def __init__(self, world: World, robot: MobileRobot) -> None:
        self.first = robot.name == "robot"
        super().__init__(
            "robot", namespace=None if self.first else robot.name, start_parameter_services=False
        )
        self.world, self.robot = world, robot
        self.messages = SensorMessages(world.lidar, "" if self.first else f"{robot.name}/")
        self._commands = 0  # since the last sense
        self._scans: deque[tuple[int, bytes]] = deque()  # to be published: time of measurement (ns), ranges
        self._latency = round(world.lidar.latency * SECOND)
        self._clock_offset = round(world.lidar.clock_offset * SECOND)
        if world.robot.stamped:
            self.create_subscription(TwistStamped, "cmd_vel", lambda msg: self.on_cmd_vel(msg.twist), 10)  # type: ignore[attr-defined]
        else:
            self.create_subscription(Twist, "cmd_vel", self.on_cmd_vel, 10)
        self.clock_pub = self.create_publisher(Clock, "/clock", 1) if self.first else None
        self.odom_pub = self.create_publisher(Odometry, "odom", 10)
        self.tf_pub = self.create_publisher(TFMessage, "/tf", 100)
        self.joint_pub = self.create_publisher(JointState, "joint_states", 10)
        self.scan_pub = self.create_publisher(LaserScan, "scan", 10)
        self.bumper_pub = self.create_publisher(Bool, "bumper", 10)
        self.static_pub = self.create_publisher(TFMessage, "/tf_static", LATCHED)
        if world.lidar.transform_delay:
            self._mounted_late = self.create_timer(world.lidar.transform_delay, self._publish_mounting)
        else:
            self.static_pub.publish(self._mounting())
        self.sense()
        self.create_timer(1.0 / SENSOR_RATE, self.sense)
        imu = world.imu
        if imu is not None:
            self.imu = ImuTopic(self, robot, imu, self.messages.base_frame)
            self.feel()
            self.create_timer(1.0 / imu.rate, self.feel)
        if robot.battery is not None:
            battery = BatteryTopic(self, robot.battery, self.messages.base_frame)
            battery.publish()
            self.create_timer(1.0, battery.publish)

    def _publish_mounting(self) -> None:
        self._mounted_late.cancel()
        self.static_pub.publish(self._mounting())

    def _mounting(self) -> TFMessage:
        """The transform from the robot to its lidar, as the robot knows it."""
        messages, lidar = self.messages, self.world.lidar
        header = Header(frame_id=messages.base_frame, stamp=self.get_clock().now().to_msg())
        transform = TransformStamped(header=header, child_frame_id=messages.scan_frame)
        move = transform.transform
        move.translation.x, move.translation.y = lidar.x, lidar.y
        move.rotation.z, move.rotation.w = math.sin(lidar.yaw / 2), math.cos(lidar.yaw / 2)
        return TFMessage(transforms=[transform])

    def on_cmd_vel(self, command: Twist) -> None:
        """Drive at this velocity from now on."""
        self._commands += 1
        try:
            self.robot.command(command.linear.x, command.angular.z)
        except CommandError as error:
            self.get_logger().error(str(error), throttle_duration_sec=1.0)

    def feel(self) -> None:
        """Publish an IMU measurement."""
        self.imu.publish(self.get_clock().now().nanoseconds)

    def sense(self) -> None:
        """Publish all other sensors."""
        robot, messages, now = self.robot, self.messages, self.get_clock().now().nanoseconds
        if self._commands > MAX_COMMAND_RATE / SENSOR_RATE:
            self._warn_of_flood()
        self._commands = 0
        stamp = divmod(now, SECOND)
        x, y, yaw, v, w = robot.odometry
        pose = x, y, math.sin(yaw / 2), math.cos(yaw / 2)
        if self.clock_pub is not None:
            self.clock_pub.publish(messages.clock.fill(*stamp))
        covariances = *robot.pose_covariance, *robot.twist_covariance
        self.odom_pub.publish(messages.odom.fill(*stamp, *pose, v, w, *covariances))
        self.tf_pub.publish(messages.tf.fill(*stamp, *pose))
        self.joint_pub.publish(messages.joints.fill(*stamp, *robot.wheels))
        if robot.lidar_works:
            self._scans.append((now, robot.scan().tobytes()))
        while self._scans and self._scans[0][0] + self._latency <= now:
            measured, ranges = self._scans.popleft()
            stamp = divmod(measured + self._clock_offset, SECOND)
            self.scan_pub.publish(messages.scan.fill(*stamp, ranges))
        self.bumper_pub.publish(messages.bumper[bool(robot.bumper)])

    def _warn_of_flood(self) -> None:
        self.get_logger().warning(
            f"More than {MAX_COMMAND_RATE} velocity commands arrived in one second; 10 to 20 are enough: "
            "check the period of the timer that sends them.",
            throttle_duration_sec=1.0,
        )
