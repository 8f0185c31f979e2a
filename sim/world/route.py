"""A closed way over the floor, to be driven round and round."""

import itertools
import math
from bisect import bisect_right
from collections.abc import Sequence

from sim.world.obstacles import Point, ring


class Route:
    """Straight lines from corner to corner (m) and from the last back to the first.

    A place on the route is the way to it from the first corner, in metres; a full turn later it is the same.
    """

    def __init__(self, corners: Sequence[Point]) -> None:
        self._legs = ring(corners)
        lengths = [math.hypot(x1 - x0, y1 - y0) for (x0, y0), (x1, y1) in self._legs]
        self._begins = [0.0, *itertools.accumulate(lengths)]
        self.length = self._begins.pop()

    def point(self, place: float) -> Point:
        """The point (x, y) of a place."""
        place %= self.length
        leg = bisect_right(self._begins, place) - 1
        (x0, y0), (x1, y1) = self._legs[leg]
        share = (place - self._begins[leg]) / math.hypot(x1 - x0, y1 - y0)
        return x0 + share * (x1 - x0), y0 + share * (y1 - y0)

    def nearest(self, x: float, y: float, begin: float = 0.0, reach: float = math.inf) -> float:
        """The first of the places nearest to a point (m), among those from `begin` on for `reach` metres."""
        reach = min(reach, self.length)
        places = [begin, begin + reach]
        for turn in (0.0, self.length):
            for leg, leg_begin in zip(self._legs, self._begins, strict=True):
                place = turn + leg_begin + _foot(*leg, x, y)
                places.append(min(max(place, begin), begin + reach))
        return min(sorted(places), key=lambda place: _distance(self.point(place), (x, y)))


def _foot(start: Point, end: Point, x: float, y: float) -> float:
    """How far along a leg the point nearest to (x, y) lies, m."""
    ux, uy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(ux, uy)
    return min(max(((x - start[0]) * ux + (y - start[1]) * uy) / length, 0.0), length)


def _distance(one: Point, other: Point) -> float:
    return math.hypot(one[0] - other[0], one[1] - other[1])
