"""Pen strokes for pages and plots: lines with a color, a width and points in meters."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from sim.world import PenDrawing, Stroke, World
from sim.world.pen_drawing import Color

Item = TypeVar("Item")

STROKES, POINTS = 500, 6_000  # limits for a page; points of all strokes together
_POINTS_PER_INCH = 72


def visible_strokes(drawing: PenDrawing) -> dict[str, Any]:
    """The visible strokes, for JSON: `checkDrawn` in web/drawing.js parses them."""
    strokes = thinned([stroke for stroke in drawing.strokes if stroke.erased is None], STROKES)
    return {
        "ground": number(drawing.ground),
        "strokes": [
            [number(stroke.color), stroke.width, [[round(x, 3), round(y, 3)] for _, x, y in points]]
            for stroke, points in _limited(strokes)
        ],
    }


def all_strokes(drawing: PenDrawing) -> dict[str, Any]:
    """All strokes, erased ones included, for JSON, with times in whole milliseconds."""
    return {
        "grounds": [
            [round(stamp * 1000), number(color)] for stamp, color in thinned(drawing.grounds, STROKES)
        ],
        "strokes": [
            [
                number(stroke.color),
                stroke.width,
                None if stroke.erased is None else round(stroke.erased * 1000),
                [[round(stamp * 1000), round(x, 3), round(y, 3)] for stamp, x, y in points],
            ]
            for stroke, points in _limited(thinned(drawing.strokes, STROKES))
        ],
    }


def _limited(strokes: list[Stroke]) -> list[tuple[Stroke, list[tuple[float, float, float]]]]:
    """The strokes, each with fewer points if all together have more than the limit."""
    count = sum(len(stroke.points) for stroke in strokes)
    share = min(1.0, POINTS / max(count, 1))
    return [(stroke, thinned(stroke.points, max(2, int(len(stroke.points) * share)))) for stroke in strokes]


def thinned(items: Sequence[Item], most: int) -> list[Item]:
    """At most `most` of the items, evenly spaced, including the first and the last."""
    if len(items) <= most:
        return list(items)
    gap = (len(items) - 1) / max(most - 1, 1)
    return [items[round(index * gap)] for index in range(most)]


def number(color: Color) -> int:
    """A color as a number, 0xRRGGBB."""
    red, green, blue = color
    return red << 16 | green << 8 | blue


def hexadecimal(color: Color) -> str:
    """A color as "#rrggbb"."""
    return f"#{number(color):06x}"


def draw_ground(axes: Axes, world: World, color: Color) -> None:
    """Fill the world's bounds with a color."""
    left, bottom, right, top = world.bounds
    size = right - left, top - bottom
    axes.add_patch(Rectangle((left, bottom), *size, color=hexadecimal(color), zorder=0.1))


def draw_strokes(axes: Axes, drawing: PenDrawing, stamp: float) -> None:
    """Draw the strokes that are visible at `stamp` (s); the axes' limits must be set."""
    axes.apply_aspect()
    assert isinstance(axes.figure, Figure)  # not a part of one
    inches = axes.get_position().width * axes.figure.get_figwidth()
    left, right = axes.get_xlim()
    for stroke, points in drawing.at(stamp):
        width = max(stroke.width / (right - left) * inches * _POINTS_PER_INCH, 0.8)
        axes.plot(*zip(*points, strict=True), color=hexadecimal(stroke.color), linewidth=width, zorder=0.9)
