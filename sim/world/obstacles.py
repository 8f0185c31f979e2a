"""Obstacles of a world other than walls, and planar geometry."""

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated

from sim.world.validated_model import Angle, Coordinate, Length, Model, positive, within

Point = tuple[Coordinate, Coordinate]
Segment = tuple[Point, Point]

GRAVITY = 9.80665
"""Standard gravity, m/s^2."""


def placed(points: Iterable[Point], x: float, y: float, yaw: float) -> tuple[Point, ...]:
    """Points given in a frame, transformed to the map frame; (x, y, yaw) is the frame's pose there."""
    c, s = math.cos(yaw), math.sin(yaw)
    return tuple((x + c * u - s * v, y + s * u + c * v) for u, v in points)


def ring(corners: Sequence[Point]) -> tuple[Segment, ...]:
    """The closed polyline through the corners: segments to each next corner, and back to the first."""
    return tuple(itertools.pairwise((*corners, *corners[:1])))


@dataclass(frozen=True)
class Box(Model):
    """A static rectangle: center (m) and yaw (rad) in the map frame.

    `width` and `height` (m) are its sizes along its own x and y.
    """

    x: Coordinate
    y: Coordinate
    yaw: Angle
    width: Length
    height: Length

    def outline(self) -> tuple[Point, Point, Point, Point]:
        """The corners in the box's own frame, counter-clockwise."""
        u, v = self.width / 2, self.height / 2
        return (-u, -v), (u, -v), (u, v), (-u, v)

    def corners(self) -> tuple[Point, ...]:
        """The corners in the map frame, counter-clockwise."""
        return placed(self.outline(), self.x, self.y, self.yaw)

    def sides(self) -> tuple[Segment, ...]:
        """The four sides as segments in the map frame."""
        return ring(self.corners())


@dataclass(frozen=True)
class MovableBox(Box):
    """A box that can be pushed: its pose at time 0, its mass (kg) and its coefficient of friction.

    Friction with the floor is up to friction * mass * gravity (N) and decelerates a sliding box by friction *
    gravity (m/s^2).
    """

    mass: Annotated[float, positive("kg")] = 0.5
    friction: Annotated[float, within(0.01, 10)] = 0.3

    @property
    def max_friction_force(self) -> float:
        """The greatest friction force between floor and box, N."""
        return self.friction * self.mass * GRAVITY

    @property
    def max_friction_torque(self) -> float:
        """The greatest friction torque about the center, N m.

        The load is distributed evenly over the base, so the lever is the mean distance of the rectangle's
        points from its center.
        """
        a, b = self.width / 2, self.height / 2
        d = math.hypot(a, b)
        lever = d + a * a / (2 * b) * math.log((b + d) / a) + b * b / (2 * a) * math.log((a + d) / b)
        return self.max_friction_force * lever / 3


@dataclass(frozen=True)
class Circle(Model):
    """A static round pillar: center in the map frame and radius (m)."""

    x: Coordinate
    y: Coordinate
    radius: Length
