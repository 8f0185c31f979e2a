"""Rotations and 4x4 matrices by transforms3d, with the names of upstream's tf_transformations.

Quaternions are (x, y, z, w), as in ROS; transforms3d has w first. Angles are radians.
"""

import math
from collections.abc import Sequence

import numpy as np
import transforms3d

Vector = Sequence[float]
_ZEROS, _ONES = np.zeros(3), np.ones(3)


def identity_matrix() -> np.ndarray:
    """The identity matrix."""
    return np.identity(4)


def translation_matrix(direction: Vector) -> np.ndarray:
    """The matrix of a translation."""
    return _matrix(np.eye(3), direction)


def translation_from_matrix(matrix: np.ndarray) -> np.ndarray:
    """The translation of a matrix."""
    return transforms3d.affines.decompose(matrix)[0]


def reflection_matrix(point: Vector, normal: Vector) -> np.ndarray:
    """The matrix of a reflection at a plane."""
    return transforms3d.reflections.rfnorm2aff(normal, point[:3])


def reflection_from_matrix(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A point on the plane of a reflection, and its normal."""
    normal, point = transforms3d.reflections.aff2rfnorm(matrix)
    return point, normal


def rotation_matrix(angle: float, direction: Vector, point: Vector | None = None) -> np.ndarray:
    """The matrix of a rotation about an axis through a point (default: the origin)."""
    return transforms3d.axangles.axangle2aff(direction, angle, point=point)


def rotation_from_matrix(matrix: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """The angle of a rotation, its axis, and a point on the axis."""
    direction, angle, point = transforms3d.axangles.aff2axangle(matrix)
    return angle, direction, point


def scale_matrix(factor: float, origin: Vector | None = None, direction: Vector | None = None) -> np.ndarray:
    """The matrix that scales about a point, in one direction or in all."""
    return transforms3d.zooms.zfdir2aff(factor, direction=direction, origin=origin)


def scale_from_matrix(matrix: np.ndarray) -> tuple[float, np.ndarray, np.ndarray | None]:
    """The factor of a scaling, its point and its direction."""
    factor, direction, origin = transforms3d.zooms.aff2zfdir(matrix)
    return factor, origin, direction


def shear_matrix(angle: float, direction: Vector, point: Vector, normal: Vector) -> np.ndarray:
    """The matrix of a shear in a direction, relative to a plane."""
    return transforms3d.shears.sadn2aff(angle, direction, normal, point)


def shear_from_matrix(matrix: np.ndarray) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """The angle of a shear, its direction, a point on its plane, and the normal."""
    angle, direction, normal, point = transforms3d.shears.aff2sadn(matrix)
    return angle, direction, point, normal


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> np.ndarray:
    """The matrix of Euler angles; by default, of roll, pitch and yaw."""
    return _matrix(transforms3d.euler.euler2mat(ai, aj, ak, axes=axes), _ZEROS)


def euler_from_matrix(matrix: np.ndarray, axes: str = "sxyz") -> tuple[float, float, float]:
    """The Euler angles of a matrix; by default, roll, pitch and yaw."""
    return transforms3d.euler.mat2euler(matrix, axes=axes)


def euler_from_quaternion(quaternion: Vector, axes: str = "sxyz") -> tuple[float, float, float]:
    """The Euler angles of a quaternion; by default, roll, pitch and yaw."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> np.ndarray:
    """The quaternion of Euler angles; by default, of roll, pitch and yaw."""
    return _w_last(transforms3d.euler.euler2quat(ai, aj, ak, axes=axes))


def quaternion_about_axis(angle: float, axis: Vector) -> np.ndarray:
    """The quaternion of a rotation about an axis."""
    return _w_last(transforms3d.quaternions.axangle2quat(axis, angle))


def quaternion_matrix(quaternion: Vector) -> np.ndarray:
    """The rotation matrix of a quaternion."""
    return _matrix(transforms3d.quaternions.quat2mat(_w_first(quaternion)), _ZEROS)


def quaternion_from_matrix(matrix: np.ndarray) -> np.ndarray:
    """The quaternion of a matrix's rotation."""
    return _w_last(transforms3d.quaternions.mat2quat(transforms3d.affines.decompose(matrix)[1]))


def quaternion_multiply(quaternion1: Vector, quaternion0: Vector) -> np.ndarray:
    """The product: the rotation that applies quaternion0 and then quaternion1."""
    return _w_last(transforms3d.quaternions.qmult(_w_first(quaternion1), _w_first(quaternion0)))


def quaternion_conjugate(quaternion: Vector) -> np.ndarray:
    """The conjugate, which is the inverse of a unit quaternion."""
    return _w_last(transforms3d.quaternions.qconjugate(_w_first(quaternion)))


def quaternion_inverse(quaternion: Vector) -> np.ndarray:
    """The inverse of a quaternion of any length."""
    return _w_last(transforms3d.quaternions.qinverse(_w_first(quaternion)))


def quaternion_slerp(
    quat0: Vector, quat1: Vector, fraction: float, spin: int = 0, shortestpath: bool = True
) -> np.ndarray:
    """The spherical linear interpolation between quat0 (fraction 0) and quat1 (fraction 1).

    spin: additional half turns; shortestpath: take the shorter of the two arcs.
    """
    begin, end = unit_vector(quat0[:4]), unit_vector(quat1[:4])
    if fraction in (0.0, 1.0):
        return end if fraction else begin
    cosine = float(np.dot(begin, end))
    if shortestpath and cosine < 0.0:
        end, cosine = -end, -cosine
    angle = math.acos(max(-1.0, min(1.0, cosine))) + spin * math.pi
    if abs(math.sin(angle)) < 1e-15:
        return begin
    return (math.sin((1.0 - fraction) * angle) * begin + math.sin(fraction * angle) * end) / math.sin(angle)


def random_quaternion(rand: Vector | None = None) -> np.ndarray:
    """A uniformly distributed random rotation. rand: three numbers from 0 to 1 that determine it."""
    share, first, second = np.random.random(3) if rand is None else rand
    small, large = math.sqrt(1.0 - share), math.sqrt(share)
    first, second = math.tau * first, math.tau * second
    return np.array(
        [
            small * math.sin(first),
            small * math.cos(first),
            large * math.sin(second),
            large * math.cos(second),
        ]
    )


def random_rotation_matrix(rand: Vector | None = None) -> np.ndarray:
    """The matrix of a random rotation."""
    return quaternion_matrix(random_quaternion(rand))


def vector_norm(
    data: Vector, axis: int | None = None, out: np.ndarray | None = None
) -> float | np.ndarray | None:
    """The length of a vector, or of those along an axis. out: an array for the result."""
    length = np.linalg.norm(np.asarray(data, float), axis=axis)
    if out is None:
        return length
    out[...] = length
    return None


def unit_vector(data: Vector, axis: int | None = None, out: np.ndarray | None = None) -> np.ndarray | None:
    """A vector scaled to length 1, or all those along an axis. out: an array for the result."""
    vectors = np.asarray(data, float)
    unit = vectors / np.linalg.norm(vectors, axis=axis, keepdims=axis is not None)
    if out is None:
        return unit
    out[...] = unit
    return None


def random_vector(size: int) -> np.ndarray:
    """Random numbers between 0 and 1."""
    return np.random.random(size)


def inverse_matrix(matrix: np.ndarray) -> np.ndarray:
    """The inverse of a matrix."""
    return np.linalg.inv(matrix)


def concatenate_matrices(*matrices: np.ndarray) -> np.ndarray:
    """The product of matrices, which applies the last one first."""
    product = np.identity(4)
    for matrix in matrices:
        product = product @ matrix
    return product


def is_same_transform(matrix0: np.ndarray, matrix1: np.ndarray) -> bool:
    """Return whether two matrices are the same transform."""
    first, second = np.asarray(matrix0, float), np.asarray(matrix1, float)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))


def compose_matrix(
    scale: Vector | None = None,
    shear: Vector | None = None,
    angles: Vector | None = None,
    translate: Vector | None = None,
    perspective: Vector | None = None,
) -> np.ndarray:
    """The matrix of these parts. angles: roll, pitch and yaw. perspective is ignored, as with upstream."""
    rotation = transforms3d.euler.euler2mat(*angles) if angles is not None else np.eye(3)
    translation, scale = _ZEROS if translate is None else translate, _ONES if scale is None else scale
    return transforms3d.affines.compose(translation, rotation, scale, _ZEROS if shear is None else shear)


def decompose_matrix(
    matrix: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, tuple[float, float, float], np.ndarray, None]:
    """Scale, shear, angles (roll, pitch, yaw) and translation of a matrix, and None for its perspective."""
    translation, rotation, scale, shear = transforms3d.affines.decompose(matrix)
    return scale, shear, euler_from_matrix(rotation), translation, None


def _matrix(rotation: np.ndarray, translation: Vector) -> np.ndarray:
    return transforms3d.affines.compose(translation, rotation, _ONES)


def _w_first(quaternion: Vector) -> np.ndarray:
    x, y, z, w = quaternion
    return np.array([w, x, y, z], float)


def _w_last(quaternion: Vector) -> np.ndarray:
    w, x, y, z = quaternion
    return np.array([x, y, z, w], float)
