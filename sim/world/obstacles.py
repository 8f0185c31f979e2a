"""The solid things of a world that are not walls."""

import math
from typing import NamedTuple

Point = tuple[float, float]
Segment = tuple[Point, Point]


class Box(NamedTuple):
    """A rectangle that does not move: centre (m) and yaw (rad) in the map frame.

    `width` and `height` (m) are its sizes along its own x and y.
    """

    x: float
    y: float
    yaw: float
    width: float
    height: float

    def corners(self) -> tuple[Point, Point, Point, Point]:
        """The corners in the map frame, counter-clockwise."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        half_width, half_height = self.width / 2, self.height / 2
        signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
        local = ((i * half_width, j * half_height) for i, j in signs)
        return tuple((self.x + c * u - s * v, self.y + s * u + c * v) for u, v in local)

    def sides(self) -> tuple[Segment, ...]:
        """The four sides as segments in the map frame."""
        corners = self.corners()
        return tuple(zip(corners, corners[1:] + corners[:1], strict=True))


class Circle(NamedTuple):
    """A round pillar that does not move: centre in the map frame and radius (m)."""

    x: float
    y: float
    radius: float
