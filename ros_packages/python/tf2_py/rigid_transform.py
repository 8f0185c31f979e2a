"""Rigid transforms: a rotation followed by a translation.

A rotation is a unit quaternion (x, y, z, w), a translation is (x, y, z) in meters.
"""

import math
from typing import NamedTuple

Quaternion = tuple[float, float, float, float]
Vector = tuple[float, float, float]


class RigidTransform(NamedTuple):
    """Converts the coordinates of a point from one frame to another."""

    rotation: Quaternion
    translation: Vector

    def after(self, first: "RigidTransform") -> "RigidTransform":
        """The composition that applies `first` and then this transform."""
        x, y, z = rotate(self.rotation, first.translation)
        translation = x + self.translation[0], y + self.translation[1], z + self.translation[2]
        return RigidTransform(multiply(self.rotation, first.rotation), translation)

    def inverse(self) -> "RigidTransform":
        """The inverse transform."""
        x, y, z, w = self.rotation
        rotation = -x, -y, -z, w
        tx, ty, tz = rotate(rotation, self.translation)
        return RigidTransform(rotation, (-tx, -ty, -tz))


IDENTITY = RigidTransform((0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0))


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """The quaternion product: the rotation that applies b and then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q: Quaternion, v: Vector) -> Vector:
    """A rotated vector."""
    x, y, z, _ = multiply(multiply(q, (*v, 0.0)), (-q[0], -q[1], -q[2], q[3]))
    return x, y, z


def normalized(q: Quaternion) -> Quaternion:
    """A quaternion scaled to length 1. Rounding errors add up in long chains of transforms."""
    length = math.hypot(*q)
    return q[0] / length, q[1] / length, q[2] / length, q[3] / length


def interpolate(a: RigidTransform, b: RigidTransform, ratio: float) -> RigidTransform:
    """A transform between a (ratio 0) and b (ratio 1), with linear translation and spherical rotation."""
    rotation = slerp(a.rotation, b.rotation, ratio)
    x, y, z = (
        start + ratio * (end - start) for start, end in zip(a.translation, b.translation, strict=True)
    )
    return RigidTransform(rotation, (x, y, z))


def slerp(a: Quaternion, b: Quaternion, ratio: float) -> Quaternion:
    """The spherical linear interpolation between a and b, along the shorter arc."""
    cosine = sum(p * q for p, q in zip(a, b, strict=True)) / (math.hypot(*a) * math.hypot(*b))
    angle = math.acos(min(1.0, abs(cosine)))
    if angle == 0.0:
        return a
    sine = math.sin(angle)
    first = math.sin((1.0 - ratio) * angle) / sine
    # q and -q are the same rotation; the sign selects the shorter arc.
    second = math.copysign(math.sin(ratio * angle), cosine) / sine
    x, y, z, w = (first * p + second * q for p, q in zip(a, b, strict=True))
    return x, y, z, w
