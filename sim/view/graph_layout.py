"""Computes the layout of a graph diagram: boxes large enough for their text, and curves between them."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import NamedTuple

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from sim.view.graph_diagram import GraphArrow, GraphBox, GraphDiagram, Key, connected_first
from sim.view.layered_layout import LayeredLayout, Point, layered_layout

FONT = 8.0  # points
LINE, PAD = 0.145, 0.09  # inches: height of a line of text, padding
RATE = "88.8 Hz"  # reserves space for a line that the page fills in and updates
INCH = 72  # points
SPREAD = 0.8  # fraction of a box's side over which its arrows are distributed


class PlacedBox(NamedTuple):
    """A box with its center and its size."""

    box: GraphBox
    center: Point
    size: Point


class PlacedArrow(NamedTuple):
    """An arrow: its start, then three points for each cubic Bezier curve; and the position of its number."""

    arrow: GraphArrow
    points: list[Point]
    middle: Point


class GraphLayout(NamedTuple):
    """A layout in inches: x to the right, y down, from 0 to width and height."""

    boxes: list[PlacedBox]
    arrows: list[PlacedArrow]
    width: float
    height: float


def lay_out(diagram: GraphDiagram, max_width: float) -> GraphLayout:
    """Lay out from left to right, or from top to bottom if that would be wider than `max_width` (inches)."""
    sizes = {key: _size(box) for key, box in connected_first(diagram)}
    layout = layered_layout(sizes, diagram.arrows)
    transform = _unchanged
    if layout.along > max_width:
        sizes = {key: (height, width) for key, (width, height) in sizes.items()}
        layout, transform = layered_layout(sizes, diagram.arrows), _transposed
    paths = _paths(layout, sizes)
    boxes = [
        PlacedBox(box, transform(layout.centers[key]), transform(sizes[key]))
        for key, box in diagram.boxes.items()
    ]
    arrows = [_placed(arrow, paths[ends], transform) for ends, arrow in diagram.arrows.items()]
    return GraphLayout(boxes, arrows, *transform((layout.along, layout.across)))


def _unchanged(point: Point) -> Point:
    return point


def _transposed(point: Point) -> Point:
    return point[::-1]


@functools.lru_cache(4096)
def _text_width(text: str) -> float:
    plain = text.replace("$", r"\$")  # text between two of them would be a formula
    path = TextPath((0, 0), plain, size=FONT, prop=FontProperties(weight="bold"))
    return path.get_extents().width / INCH


def _size(box: GraphBox) -> Point:
    return max(_text_width(line or RATE) for line in box.lines) + 2 * PAD, LINE * len(box.lines) + PAD


def _placed(arrow: GraphArrow, path: list[Point], transform: Callable[[Point], Point]) -> PlacedArrow:
    """A curve through all points of the path, with horizontal tangents at each."""
    points = [path[0]]
    for (x, y), (u, v) in pairwise(path):
        middle = (x + u) / 2
        points += [(middle, y), (middle, v), (u, v)]
    (x, y), (u, v) = path[len(path) // 2 - 1 : len(path) // 2 + 1]
    return PlacedArrow(arrow, [transform(point) for point in points], transform(((x + u) / 2, (y + v) / 2)))


def _paths(layout: LayeredLayout, sizes: Mapping[Key, Point]) -> dict[tuple[Key, Key], list[Point]]:
    """The paths of all arrows, from the side of one box to the side of the other.

    Arrows at the same side are distributed over it, in the order of their other ends.
    """
    paths = {}
    sides: dict[tuple[Key, bool], list[tuple[float, int, tuple[Key, Key]]]] = {}
    for ends, path in layout.paths.items():
        begin, end = (layout.centers[key] for key in ends)
        inner = path[1:-1]
        if len(inner) > 1 and abs(inner[0][0] - begin[0]) > abs(inner[-1][0] - begin[0]):
            inner = inner[::-1]  # the layout has reversed it
        paths[ends] = path = [begin, *inner, end]
        for index, key in ((0, ends[0]), (-1, ends[1])):
            neighbor = path[1 if index == 0 else -2]
            right = neighbor[0] > layout.centers[key][0]
            sides.setdefault((key, right), []).append((neighbor[1], index, ends))
    for (key, right), arrows in sides.items():
        (x, y), (width, height) = layout.centers[key], sizes[key]
        for number, (_, index, ends) in enumerate(sorted(arrows)):
            offset = (number + 0.5) / len(arrows) - 0.5
            paths[ends][index] = x + (width if right else -width) / 2, y + SPREAD * height * offset
    return paths
