"""A pose in the plane, and its text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

Point = tuple[float, float]
"""x and y in meters."""


class Pose2D(NamedTuple):
    """A position and a heading in the plane of some frame."""

    x: float  # m
    y: float  # m
    yaw: float  # rad, in (-pi, pi] where it comes from a message

    @classmethod
    def from_message(cls, message: Any) -> Pose2D:
        """Return the planar part of a geometry_msgs Pose or Transform."""
        place = message.translation if hasattr(message, "translation") else message.position
        turn = message.rotation if hasattr(message, "rotation") else message.orientation
        return cls(place.x, place.y, math.remainder(2 * math.atan2(turn.z, turn.w), math.tau))

    def point(self, point: Sequence[float]) -> Point:
        """Return a point of this pose's own frame, such as base_link, in the frame of the pose."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return self.x + cos * point[0] - sin * point[1], self.y + sin * point[0] + cos * point[1]

    def towards(self, other: Pose2D, ratio: float) -> Pose2D:
        """Return a pose between this one (ratio 0) and another (ratio 1), turned the shorter way."""
        turn = math.remainder(other.yaw - self.yaw, math.tau)
        x, y = (a + ratio * (b - a) for a, b in zip(self[:2], other[:2], strict=True))
        return Pose2D(x, y, self.yaw + ratio * turn)

    def is_near(self, other: Pose2D, distance: float, angle: float) -> bool:
        """Return whether two poses differ by at most a distance (m) and an angle (rad).

        NaN is near nothing.
        """
        turn = self.yaw - other.yaw
        turned = abs(math.remainder(turn, math.tau)) if math.isfinite(turn) else math.inf
        return math.dist(self[:2], other[:2]) <= distance and turned <= angle

    def __str__(self) -> str:
        return f"x {self.x:.2f} m, y {self.y:.2f} m, yaw {self.yaw:.2f} rad"
