"""`Route`: a closed path that a robot or a person follows repeatedly."""

import itertools
import math
from bisect import bisect_right
from collections.abc import Sequence

from sim.world.obstacles import Point, ring


class Route:
    """Straight lines from corner to corner (m) and from the last back to the first.

    A position on the route is the distance along it from the first corner, in meters, modulo its length.
    """

    def __init__(self, corners: Sequence[Point]) -> None:
        self._legs = ring(corners)
        lengths = [math.hypot(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in self._legs]
        self._begins = [0.0, *itertools.accumulate(lengths)]
        self.length = self._begins.pop()

    def point(self, distance: float) -> Point:
        """The point (x, y) at a distance along the route."""
        distance %= self.length
        leg = bisect_right(self._begins, distance) - 1
        (x0, y0), (x1, y1) = self._legs[leg]
        share = (distance - self._begins[leg]) / math.hypot(x1 - x0, y1 - y0)
        return x0 + share * (x1 - x0), y0 + share * (y1 - y0)

    def nearest(self, x: float, y: float, begin: float = 0.0, reach: float = math.inf) -> float:
        """The position on the route that is nearest to a point (m); of several, the first.

        Only the `reach` meters of the route from the position `begin` on are searched.
        """
        reach = min(reach, self.length)
        candidates = [begin, begin + reach]
        for turn in (0.0, self.length):
            for leg, leg_begin in zip(self._legs, self._begins, strict=True):
                candidate = turn + leg_begin + _projection(*leg, x, y)
                candidates.append(min(max(candidate, begin), begin + reach))
        return min(sorted(candidates), key=lambda candidate: _distance(self.point(candidate), (x, y)))


def _projection(start: Point, end: Point, x: float, y: float) -> float:
    """Return how far along a leg its nearest point to (x, y) is, m."""
    ux, uy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(ux, uy)
    return min(max(((x - start[0]) * ux + (y - start[1]) * uy) / length, 0.0), length)


def _distance(one: Point, other: Point) -> float:
    return math.hypot(one[0] - other[0], one[1] - other[1])
