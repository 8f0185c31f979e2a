"""Walls as worlds have them: pairs of points."""

import itertools

from grader.geometry.pose import Point


def rectangle(left: float, bottom: float, right: float, top: float) -> tuple[tuple[Point, Point], ...]:
    """Return the four walls (m) round a rectangle, such as the bounds of a world."""
    corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)]
    return tuple(itertools.pairwise(corners))
