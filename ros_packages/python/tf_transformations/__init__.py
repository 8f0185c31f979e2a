"""Rotations and 4x4 matrices by transforms3d, with the names of upstream's tf_transformations.

Quaternions are (x, y, z, w), as in ROS; transforms3d has w first. Angles are radians.
"""

import math
from collections.abc import Sequence

import numpy as np
import transforms3d

Vector = Sequence[float]
_STILL, _WHOLE = np.zeros(3), np.ones(3)


def identity_matrix() -> np.ndarray:
    """The matrix that changes nothing."""
    return np.identity(4)


def translation_matrix(direction: Vector) -> np.ndarray:
    """The matrix that shifts by a vector."""
    return _matrix(np.eye(3), direction)


def translation_from_matrix(matrix: np.ndarray) -> np.ndarray:
    """The shift in a matrix."""
    return transforms3d.affines.decompose(matrix)[0]


def reflection_matrix(point: Vector, normal: Vector) -> np.ndarray:
    """The matrix that mirrors at a plane."""
    return transforms3d.reflections.rfnorm2aff(normal, point[:3])


def reflection_from_matrix(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A point of the plane and its normal."""
    normal, point = transforms3d.reflections.aff2rfnorm(matrix)
    return point, normal


def rotation_matrix(angle: float, direction: Vector, point: Vector | None = None) -> np.ndarray:
    """The matrix that turns about an axis through a point, or through the origin."""
    return transforms3d.axangles.axangle2aff(direction, angle, point=point)


def rotation_from_matrix(matrix: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """The angle, the axis and a point of it."""
    direction, angle, point = transforms3d.axangles.aff2axangle(matrix)
    return angle, direction, point


def scale_matrix(factor: float, origin: Vector | None = None, direction: Vector | None = None) -> np.ndarray:
    """The matrix that scales about a point, along a direction or along all."""
    return transforms3d.zooms.zfdir2aff(factor, direction=direction, origin=origin)


def scale_from_matrix(matrix: np.ndarray) -> tuple[float, np.ndarray, np.ndarray | None]:
    """The factor, the point and the direction."""
    factor, direction, origin = transforms3d.zooms.aff2zfdir(matrix)
    return factor, origin, direction


def shear_matrix(angle: float, direction: Vector, point: Vector, normal: Vector) -> np.ndarray:
    """The matrix that shears along a direction, at a plane."""
    return transforms3d.shears.sadn2aff(angle, direction, normal, point)


def shear_from_matrix(matrix: np.ndarray) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """The angle, the direction, a point of the plane and its normal."""
    angle, direction, normal, point = transforms3d.shears.aff2sadn(matrix)
    return angle, direction, point, normal


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> np.ndarray:
    """The matrix of three turns; as they stand, of roll, pitch and yaw."""
    return _matrix(transforms3d.euler.euler2mat(ai, aj, ak, axes=axes), _STILL)


def euler_from_matrix(matrix: np.ndarray, axes: str = "sxyz") -> tuple[float, float, float]:
    """The three turns in a matrix."""
    return transforms3d.euler.mat2euler(matrix, axes=axes)


def euler_from_quaternion(quaternion: Vector, axes: str = "sxyz") -> tuple[float, float, float]:
    """The three turns of a quaternion; as they stand, roll, pitch and yaw."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> np.ndarray:
    """The quaternion of three turns; as they stand, of roll, pitch and yaw."""
    return _w_last(transforms3d.euler.euler2quat(ai, aj, ak, axes=axes))


def quaternion_about_axis(angle: float, axis: Vector) -> np.ndarray:
    """The quaternion of a turn about an axis."""
    return _w_last(transforms3d.quaternions.axangle2quat(axis, angle))


def quaternion_matrix(quaternion: Vector) -> np.ndarray:
    """The matrix that turns as a quaternion does."""
    return _matrix(transforms3d.quaternions.quat2mat(_w_first(quaternion)), _STILL)


def quaternion_from_matrix(matrix: np.ndarray) -> np.ndarray:
    """The quaternion that turns as a matrix does."""
    return _w_last(transforms3d.quaternions.mat2quat(transforms3d.affines.decompose(matrix)[1]))


def quaternion_multiply(quaternion1: Vector, quaternion0: Vector) -> np.ndarray:
    """The turn that does quaternion0, and then quaternion1."""
    return _w_last(transforms3d.quaternions.qmult(_w_first(quaternion1), _w_first(quaternion0)))


def quaternion_conjugate(quaternion: Vector) -> np.ndarray:
    """The turn back, of a quaternion of length 1."""
    return _w_last(transforms3d.quaternions.qconjugate(_w_first(quaternion)))


def quaternion_inverse(quaternion: Vector) -> np.ndarray:
    """The turn back, whatever its length."""
    return _w_last(transforms3d.quaternions.qinverse(_w_first(quaternion)))


def quaternion_slerp(
    quat0: Vector, quat1: Vector, fraction: float, spin: int = 0, shortestpath: bool = True
) -> np.ndarray:
    """The turn on the way from quat0 (fraction 0) to quat1 (fraction 1).

    spin: half turns more on the way; shortestpath: of the two ways round, the short one.
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
    """A random turn, each as likely as any other; rand: three numbers from 0 to 1 to make it of."""
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
    """The matrix of a random turn."""
    return quaternion_matrix(random_quaternion(rand))


def vector_norm(
    data: Vector, axis: int | None = None, out: np.ndarray | None = None
) -> float | np.ndarray | None:
    """The length of a vector, or of those along an axis; into out, if this is given."""
    length = np.linalg.norm(np.asarray(data, float), axis=axis)
    if out is None:
        return length
    out[...] = length
    return None


def unit_vector(data: Vector, axis: int | None = None, out: np.ndarray | None = None) -> np.ndarray | None:
    """A vector with length 1, or all those along an axis; into out, if this is given."""
    vectors = np.asarray(data, float)
    unit = vectors / np.linalg.norm(vectors, axis=axis, keepdims=axis is not None)
    if out is None:
        return unit
    out[...] = unit
    return None


def random_vector(size: int) -> np.ndarray:
    """Random numbers from 0 to 1."""
    return np.random.random(size)


def inverse_matrix(matrix: np.ndarray) -> np.ndarray:
    """The matrix back."""
    return np.linalg.inv(matrix)


def concatenate_matrices(*matrices: np.ndarray) -> np.ndarray:
    """The product of all: the last one is done first."""
    whole = np.identity(4)
    for matrix in matrices:
        whole = whole @ matrix
    return whole


def is_same_transform(matrix0: np.ndarray, matrix1: np.ndarray) -> bool:
    """Whether two matrices do the same to all points."""
    first, second = np.asarray(matrix0, float), np.asarray(matrix1, float)
    return bool(np.allclose(first / first[3, 3], second / second[3, 3]))


def compose_matrix(
    scale: Vector | None = None,
    shear: Vector | None = None,
    angles: Vector | None = None,
    translate: Vector | None = None,
    perspective: Vector | None = None,
) -> np.ndarray:
    """The matrix of all these; angles: roll, pitch and yaw. A perspective is left out, as upstream does."""
    turn = transforms3d.euler.euler2mat(*angles) if angles is not None else np.eye(3)
    shift, zoom = _STILL if translate is None else translate, _WHOLE if scale is None else scale
    return transforms3d.affines.compose(shift, turn, zoom, np.zeros(3) if shear is None else shear)


def decompose_matrix(
    matrix: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, tuple[float, float, float], np.ndarray, None]:
    """Scale, shear, angles (roll, pitch, yaw) and translation of a matrix; of a perspective, None."""
    shift, turn, zoom, shear = transforms3d.affines.decompose(matrix)
    return zoom, shear, euler_from_matrix(turn), shift, None


def _matrix(turn: np.ndarray, shift: Vector) -> np.ndarray:
    return transforms3d.affines.compose(shift, turn, _WHOLE)


def _w_first(quaternion: Vector) -> np.ndarray:
    x, y, z, w = quaternion
    return np.array([w, x, y, z], float)


def _w_last(quaternion: Vector) -> np.ndarray:
    w, x, y, z = quaternion
    return np.array([x, y, z, w], float)
