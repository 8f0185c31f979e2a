"""Templates of the messages that a robot's sensors publish, and its frame names."""

from __future__ import annotations

import array
import math

from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Bool, Header
from tf2_msgs.msg import TFMessage

from sim.ros.messages.codec import encode
from sim.ros.messages.template import STAMP, Template
from sim.ros.robots.rates import SENSOR_RATE
from sim.world.lidar import LidarModel

WHEELS = ["wheel_left_joint", "wheel_right_joint"]
POSE = ("position.x", "position.y", "orientation.z", "orientation.w")
# Of x, y and yaw, whose variances are at 0, 7 and 35, and of the forward velocity and the yaw rate; the rest
# of the 6 x 6 numbers is exactly 0 in a flat world, for a robot that can't move sideways.
COVARIANCES = (
    *(f"pose.covariance.{6 * row + column}" for row in (0, 1, 5) for column in (0, 1, 5)),
    *(f"twist.covariance.{6 * row + column}" for row in (0, 5) for column in (0, 5)),
)
TRANSFORM = ("translation.x", "translation.y", "rotation.z", "rotation.w")


class SensorMessages:
    """The message templates of one robot. prefix: of its frame names.

    bumper: the bytes of a message for a released and for a pressed bumper.
    """

    def __init__(self, lidar: LidarModel, prefix: str = "") -> None:
        self.odom_frame, self.base_frame = f"{prefix}odom", f"{prefix}base_link"
        self.scan_frame = f"{prefix}base_scan"
        moves = {"header": Header(frame_id=self.odom_frame), "child_frame_id": self.base_frame}
        self.clock = Template(Clock(), ["clock.sec", "clock.nanosec"])
        pose = [f"pose.pose.{name}" for name in POSE]
        twist = ["twist.twist.linear.x", "twist.twist.angular.z"]
        self.odom = Template(Odometry(**moves), [*STAMP, *pose, *twist, *COVARIANCES])
        fields = [*STAMP, *(f"transform.{name}" for name in TRANSFORM)]
        transforms = TFMessage(transforms=[TransformStamped(**moves)])
        self.tf = Template(transforms, [f"transforms.0.{field}" for field in fields])
        joints = JointState(name=WHEELS, position=[0.0, 0.0], velocity=[0.0, 0.0])
        self.joints = Template(joints, [*STAMP, "position", "velocity"])
        self.scan = Template(self._scan(lidar), [*STAMP, "ranges"])
        self.bumper = [encode(Bool(data=pressed)) for pressed in (False, True)]

    def _scan(self, lidar: LidarModel) -> LaserScan:
        return LaserScan(
            header=Header(frame_id=self.scan_frame),
            angle_max=math.tau - lidar.angle_increment,
            angle_increment=lidar.angle_increment,
            scan_time=1 / SENSOR_RATE,
            range_min=lidar.range_min,
            range_max=lidar.range_max,
            ranges=array.array("f", [0.0] * lidar.rays),
        )
