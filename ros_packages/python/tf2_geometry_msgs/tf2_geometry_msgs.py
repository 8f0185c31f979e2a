"""What a transform does to points, vectors, poses and polygons. The result has the transform's header."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import tf2_ros
from geometry_msgs.msg import (
    Point,
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    Vector3,
    Vector3Stamped,
)
from tf2_py.rigid import Motion, normalised, rotate


def to_msg_msg(msg: Any) -> Any:
    """A message as a message."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """A message of a message."""
    return msg


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """A point: turned and shifted."""
    place = _motion(transform).after(_at(point.point)).shift
    return PointStamped(header=transform.header, point=_xyz(Point, place))


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """A vector, such as a velocity: turned, but not shifted."""
    vector = vector3.vector
    turned = rotate(_motion(transform).rotation, (vector.x, vector.y, vector.z))
    return Vector3Stamped(header=transform.header, vector=_xyz(Vector3, turned))


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """A pose: its place turned and shifted, its direction turned."""
    direction = pose.orientation
    turn = normalised((direction.x, direction.y, direction.z, direction.w))
    moved = _motion(transform).after(_at(pose.position)._replace(rotation=turn))
    x, y, z, w = normalised(moved.rotation)
    return Pose(position=_xyz(Point, moved.shift), orientation=Quaternion(x=x, y=y, z=z, w=w))


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """A pose with a header."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """A pose and how sure it is."""
    moved = PoseWithCovarianceStamped(header=transform.header)
    moved.pose.pose = do_transform_pose(pose.pose.pose, transform)
    moved.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return moved


def do_transform_polygon_stamped(polygon: PolygonStamped, transform: TransformStamped) -> PolygonStamped:
    """A polygon: each of its points."""
    motion, moved = _motion(transform), PolygonStamped(header=transform.header)
    for point in polygon.polygon.points:
        moved.polygon.points.append(_xyz(Point32, motion.after(_at(point)).shift))
    return moved


def transform_covariance(cov_in: Sequence[float], transform: TransformStamped) -> np.ndarray:
    """A covariance of x, y, z and the turns about them, row by row (36 numbers), in another frame."""
    turn = _motion(transform).rotation
    matrix = np.array([rotate(turn, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]).T
    both = np.kron(np.eye(2), matrix)
    return (both @ np.reshape(cov_in, (6, 6)) @ both.T).ravel()


def _motion(transform: TransformStamped) -> Motion:
    shift, turn = transform.transform.translation, transform.transform.rotation
    return Motion(normalised((turn.x, turn.y, turn.z, turn.w)), (shift.x, shift.y, shift.z))


def _at(point: Any) -> Motion:
    return Motion((0.0, 0.0, 0.0, 1.0), (point.x, point.y, point.z))


def _xyz(kind: type, values: Sequence[float]) -> Any:
    x, y, z = values
    return kind(x=x, y=y, z=z)


for _kind, _transform in (
    (PointStamped, do_transform_point),
    (Vector3Stamped, do_transform_vector3),
    (PoseStamped, do_transform_pose_stamped),
    (PoseWithCovarianceStamped, do_transform_pose_with_covariance_stamped),
    (PolygonStamped, do_transform_polygon_stamped),
):
    tf2_ros.TransformRegistration().add(_kind, _transform)
for _kind in (PointStamped, Vector3Stamped, PoseStamped):
    tf2_ros.ConvertRegistration().add_to_msg(_kind, to_msg_msg)
    tf2_ros.ConvertRegistration().add_from_msg(_kind, from_msg_msg)
