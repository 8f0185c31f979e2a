"""The solid things of a world that are not walls."""

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Annotated

from sim.world.model import Angle, Coordinate, Length, Model, positive, within

Point = tuple[Coordinate, Coordinate]
Segment = tuple[Point, Point]

GRAVITY = 9.80665
"""Standard gravity, m/s^2."""


def placed(points: Iterable[Point], x: float, y: float, yaw: float) -> tuple[Point, ...]:
    """Points of a frame that lies at (x, y, yaw) in the map frame, as points of the map frame."""
    c, s = math.cos(yaw), math.sin(yaw)
    return tuple((x + c * u - s * v, y + s * u + c * v) for u, v in points)


def ring(corners: Sequence[Point]) -> tuple[Segment, ...]:
    """The lines from each corner to the next, and from the last to the first."""
    return tuple(itertools.pairwise((*corners, *corners[:1])))


@dataclass(frozen=True)
class Box(Model):
    """A rectangle that does not move: centre (m) and yaw (rad) in the map frame.

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

    def corners(self) -> tuple[Point, Point, Point, Point]:
        """The corners in the map frame, counter-clockwise."""
        return placed(self.outline(), self.x, self.y, self.yaw)

    def sides(self) -> tuple[Segment, ...]:
        """The four sides as segments in the map frame."""
        return ring(self.corners())


@dataclass(frozen=True)
class MovableBox(Box):
    """A box that can be pushed over the floor: where it is at time 0, its mass (kg) and the floor's friction.

    The floor holds it with up to friction * mass * gravity, and slows it down by friction * gravity once it
    slides.
    """

    mass: Annotated[float, positive("kg")] = 0.5
    friction: Annotated[float, within(0.01, 10)] = 0.3

    @property
    def grip(self) -> float:
        """The greatest force with which the floor holds the box, N."""
        return self.friction * self.mass * GRAVITY

    @property
    def twist_grip(self) -> float:
        """The greatest torque about its centre with which the floor holds the box, N m.

        The box weighs equally on all of its floor, so the lever is the mean distance of the rectangle's
        points from its centre.
        """
        a, b = self.width / 2, self.height / 2
        d = math.hypot(a, b)
        lever = d + a * a / (2 * b) * math.log((b + d) / a) + b * b / (2 * a) * math.log((a + d) / b)
        return self.grip * lever / 3


@dataclass(frozen=True)
class Circle(Model):
    """A round pillar that does not move: centre in the map frame and radius (m)."""

    x: Coordinate
    y: Coordinate
    radius: Length
