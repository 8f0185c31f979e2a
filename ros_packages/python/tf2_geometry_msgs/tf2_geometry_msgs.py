"""Transforms points, vectors, poses and polygons. The result has the header of the transform."""

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
from tf2_py.rigid_transform import RigidTransform, normalized, rotate

AXES = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def to_msg_msg(msg: Any) -> Any:
    """The message itself."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """The message itself."""
    return msg


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """A point, rotated and translated."""
    position = _rigid_transform(transform).after(_translation(point.point)).translation
    return PointStamped(header=transform.header, point=_xyz(Point, position))


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """A vector, such as a velocity, rotated but not translated."""
    vector = vector3.vector
    rotated = rotate(_rigid_transform(transform).rotation, (vector.x, vector.y, vector.z))
    return Vector3Stamped(header=transform.header, vector=_xyz(Vector3, rotated))


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """A pose, rotated and translated."""
    orientation = pose.orientation
    rotation = normalized((orientation.x, orientation.y, orientation.z, orientation.w))
    result = _rigid_transform(transform).after(_translation(pose.position)._replace(rotation=rotation))
    x, y, z, w = normalized(result.rotation)
    return Pose(position=_xyz(Point, result.translation), orientation=Quaternion(x=x, y=y, z=z, w=w))


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """A pose with a header."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """A pose and its covariance."""
    result = PoseWithCovarianceStamped(header=transform.header)
    result.pose.pose = do_transform_pose(pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def do_transform_polygon_stamped(polygon: PolygonStamped, transform: TransformStamped) -> PolygonStamped:
    """A polygon, with each of its points transformed."""
    rigid_transform, result = _rigid_transform(transform), PolygonStamped(header=transform.header)
    for point in polygon.polygon.points:
        position = rigid_transform.after(_translation(point)).translation
        result.polygon.points.append(_xyz(Point32, position))
    return result


def transform_covariance(cov_in: Sequence[float], transform: TransformStamped) -> np.ndarray:
    """A covariance of x, y, z and the rotations about them (36 numbers, row-major), in another frame."""
    rotation = _rigid_transform(transform).rotation
    matrix = np.array([rotate(rotation, axis) for axis in AXES]).T
    block_diagonal = np.kron(np.eye(2), matrix)
    return (block_diagonal @ np.reshape(cov_in, (6, 6)) @ block_diagonal.T).ravel()


def _rigid_transform(message: TransformStamped) -> RigidTransform:
    translation, rotation = message.transform.translation, message.transform.rotation
    return RigidTransform(
        normalized((rotation.x, rotation.y, rotation.z, rotation.w)),
        (translation.x, translation.y, translation.z),
    )


def _translation(point: Any) -> RigidTransform:
    return RigidTransform((0.0, 0.0, 0.0, 1.0), (point.x, point.y, point.z))


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
