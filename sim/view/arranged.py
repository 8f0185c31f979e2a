"""Where everything of a graph's picture lies: boxes that hold their words, and curves from one to another."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import NamedTuple

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from sim.view.layered import Layout, Point, layered
from sim.view.wiring import Arrow, Box, Key, Wiring, columns

FONT = 8.0  # points
LINE, PAD = 0.145, 0.09  # inches: a line of text, around it
RATE = "88.8 Hz"  # takes the place of a line that the page writes, again and again
INCH = 72  # points
SPREAD = 0.8  # of the side of a box, over which its arrows are spread


class PlacedBox(NamedTuple):
    """A box, its centre and its size."""

    box: Box
    centre: Point
    size: Point


class PlacedArrow(NamedTuple):
    """Its beginning, then three points for each of its cubic curves; and where its number stands."""

    arrow: Arrow
    points: list[Point]
    middle: Point


class Arranged(NamedTuple):
    """A picture in inches: x to the right, y down, from 0 to width and height."""

    boxes: list[PlacedBox]
    arrows: list[PlacedArrow]
    width: float
    height: float


def arranged(shown: Wiring, widest: float) -> Arranged:
    """Place everything from left to right; where that is wider than `widest` (inches), from top to bottom."""
    sizes = {key: _size(box) for key, box in columns(shown)}
    layout = layered(sizes, shown.arrows)
    turn = _as_it_is
    if layout.along > widest:
        sizes = {key: (height, width) for key, (width, height) in sizes.items()}
        layout, turn = layered(sizes, shown.arrows), _turned
    ways = _ways(layout, sizes)
    boxes = [PlacedBox(box, turn(layout.centres[key]), turn(sizes[key])) for key, box in shown.boxes.items()]
    arrows = [_placed(arrow, ways[ends], turn) for ends, arrow in shown.arrows.items()]
    return Arranged(boxes, arrows, *turn((layout.along, layout.across)))


def _as_it_is(point: Point) -> Point:
    return point


def _turned(point: Point) -> Point:
    return point[::-1]


@functools.lru_cache(4096)
def _text_width(text: str) -> float:
    plain = text.replace("$", r"\$")  # between two of them would be a formula
    path = TextPath((0, 0), plain, size=FONT, prop=FontProperties(weight="bold"))
    return path.get_extents().width / INCH


def _size(box: Box) -> Point:
    return max(_text_width(line or RATE) for line in box.lines) + 2 * PAD, LINE * len(box.lines) + PAD


def _placed(arrow: Arrow, way: list[Point], turn: Callable[[Point], Point]) -> PlacedArrow:
    """Through all points of its way, straight along the layers at each."""
    points = [way[0]]
    for (x, y), (u, v) in pairwise(way):
        middle = (x + u) / 2
        points += [(middle, y), (middle, v), (u, v)]
    (x, y), (u, v) = way[len(way) // 2 - 1 : len(way) // 2 + 1]
    return PlacedArrow(arrow, [turn(point) for point in points], turn(((x + u) / 2, (y + v) / 2)))


def _ways(layout: Layout, sizes: Mapping[Key, Point]) -> dict[tuple[Key, Key], list[Point]]:
    """The ways of all arrows, from the side of one box to the side of the other.

    Those that share a side are spread over it, in the order of where they come from or go to.
    """
    ways = {}
    sides: dict[tuple[Key, bool], list[tuple[float, int, tuple[Key, Key]]]] = {}
    for ends, way in layout.ways.items():
        begin, end = (layout.centres[key] for key in ends)
        inner = way[1:-1]
        if len(inner) > 1 and abs(inner[0][0] - begin[0]) > abs(inner[-1][0] - begin[0]):
            inner = inner[::-1]  # the layout has turned it round
        ways[ends] = way = [begin, *inner, end]
        for place, key in ((0, ends[0]), (-1, ends[1])):
            neighbour = way[1 if place == 0 else -2]
            right = neighbour[0] > layout.centres[key][0]
            sides.setdefault((key, right), []).append((neighbour[1], place, ends))
    for (key, right), arrows in sides.items():
        (x, y), (width, height) = layout.centres[key], sizes[key]
        for number, (_, place, ends) in enumerate(sorted(arrows)):
            share = (number + 0.5) / len(arrows) - 0.5
            ways[ends][place] = x + (width if right else -width) / 2, y + SPREAD * height * share
    return ways
