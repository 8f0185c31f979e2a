"""Messages in the frame map, as the programs of a delivery robot exchange them."""

import math
from collections.abc import Iterable, Sequence

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Pose, PoseArray, PoseStamped
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""The last messages are stored for subscriptions that come later."""


def seconds(stamp: Time) -> float:
    """Return a message's stamp in s."""
    return stamp.sec + stamp.nanosec / 1e9  # type: ignore[no-any-return]  # as the lesson has it


def pose_2d(pose: Pose) -> tuple[float, float, float]:
    """Return a Pose as x (m), y (m) and yaw (rad)."""
    return pose.position.x, pose.position.y, 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def posed(x: float, y: float, yaw: float = 0.0) -> Pose:
    """Return a Pose on the floor."""
    pose = Pose()
    pose.position.x, pose.position.y = float(x), float(y)
    pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return pose


def pose_stamped(stamp: Time, x: float, y: float, yaw: float = 0.0) -> PoseStamped:
    """Return a PoseStamped in map."""
    message = PoseStamped(pose=posed(x, y, yaw))
    message.header.stamp, message.header.frame_id = stamp, "map"
    return message


def pose_array(stamp: Time, points: Iterable[Sequence[float]]) -> PoseArray:
    """Return a PoseArray in map from points (x, y)."""
    message = PoseArray(poses=[posed(*point) for point in points])
    message.header.stamp, message.header.frame_id = stamp, "map"
    return message
