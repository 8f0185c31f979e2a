"""Rigid motions: a rotation, then a shift.

A rotation is a quaternion (x, y, z, w) of length 1, a shift is (x, y, z) in metres.
"""

import math
from typing import NamedTuple

Quaternion = tuple[float, float, float, float]
Vector = tuple[float, float, float]


class Motion(NamedTuple):
    """Takes the coordinates of a point in one frame to those in another."""

    rotation: Quaternion
    shift: Vector

    def after(self, first: "Motion") -> "Motion":
        """The motion that does `first`, and then this one."""
        x, y, z = rotate(self.rotation, first.shift)
        shift = x + self.shift[0], y + self.shift[1], z + self.shift[2]
        return Motion(multiply(self.rotation, first.rotation), shift)

    def inverse(self) -> "Motion":
        """The motion back."""
        x, y, z, w = self.rotation
        back = -x, -y, -z, w
        sx, sy, sz = rotate(back, self.shift)
        return Motion(back, (-sx, -sy, -sz))


STAY = Motion((0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0))


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """The rotation that does b, and then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q: Quaternion, v: Vector) -> Vector:
    """A vector, turned by a rotation."""
    x, y, z, _ = multiply(multiply(q, (*v, 0.0)), (-q[0], -q[1], -q[2], q[3]))
    return x, y, z


def normalised(q: Quaternion) -> Quaternion:
    """The same rotation with length 1: rounding makes others of them in long chains."""
    length = math.hypot(*q)
    return q[0] / length, q[1] / length, q[2] / length, q[3] / length


def between(a: Motion, b: Motion, ratio: float) -> Motion:
    """A motion on the way from a (ratio 0) to b (ratio 1): straight, and turning evenly the short way."""
    rotation = slerp(a.rotation, b.rotation, ratio)
    x, y, z = (start + ratio * (end - start) for start, end in zip(a.shift, b.shift, strict=True))
    return Motion(rotation, (x, y, z))


def slerp(a: Quaternion, b: Quaternion, ratio: float) -> Quaternion:
    """A rotation on the short way from a to b, at an even speed."""
    cosine = sum(p * q for p, q in zip(a, b, strict=True)) / (math.hypot(*a) * math.hypot(*b))
    angle = math.acos(min(1.0, abs(cosine)))
    if angle == 0.0:
        return a
    whole = math.sin(angle)
    first = math.sin((1.0 - ratio) * angle) / whole
    # q and -q are one rotation: of the two ways round, the short one.
    second = math.copysign(math.sin(ratio * angle), cosine) / whole
    x, y, z, w = (first * p + second * q for p, q in zip(a, b, strict=True))
    return x, y, z, w
