"""The lines that turtles draw with their pens; points have stamps, so that replays can show the drawing."""

from __future__ import annotations

import bisect
from collections.abc import Iterator
from dataclasses import dataclass, field

Color = tuple[int, int, int]
"""Red, green and blue, each from 0 to 255."""
_MOST_POINTS = 20_000  # kept in a run without an end


@dataclass(slots=True)
class Stroke:
    """One continuous line of a pen: its color and width (m), and points (stamp, x, y) in s and m.

    pen: the name of the body that has the pen. erased: when the line was erased (s), or None.
    """

    pen: str
    color: Color
    width: float
    points: list[tuple[float, float, float]] = field(default_factory=list)
    erased: float | None = None

    def is_visible(self, stamp: float) -> bool:
        """Return whether any of it is visible at `stamp` (s)."""
        return self.points[0][0] <= stamp and (self.erased is None or stamp < self.erased)

    def until(self, stamp: float) -> list[tuple[float, float]]:
        """The points (x, y) drawn up to `stamp` (s)."""
        last = bisect.bisect_right(self.points, stamp + 1e-6, key=lambda point: point[0])
        return [point[1:] for point in self.points[:last]]


@dataclass(slots=True)
class PenDrawing:
    """All strokes, oldest first, and the colors of the ground, each from a stamp (s) on."""

    strokes: list[Stroke] = field(default_factory=list)
    grounds: list[tuple[float, Color]] = field(default_factory=list)

    @property
    def ground(self) -> Color:
        """The current color of the ground."""
        return self.grounds[-1][1]

    def ground_at(self, stamp: float) -> Color:
        """The color of the ground at `stamp` (s)."""
        return next(
            (color for since, color in reversed(self.grounds) if since <= stamp), self.grounds[0][1]
        )

    def set_ground(self, stamp: float, color: Color) -> None:
        """Change the color of the ground from `stamp` (s) on."""
        if not self.grounds or color != self.ground:
            self.grounds.append((stamp, color))

    def at(self, stamp: float) -> Iterator[tuple[Stroke, list[tuple[float, float]]]]:
        """The strokes that are visible at `stamp` (s), each with its points up to then."""
        return ((stroke, stroke.until(stamp)) for stroke in self.strokes if stroke.is_visible(stamp))

    def erase(self, stamp: float) -> None:
        """Erase all visible strokes."""
        for stroke in self.strokes:
            if stroke.erased is None:
                stroke.erased = stamp

    def discard_history(self) -> None:
        """Keep only visible strokes, with a bounded number of points, for a run without an end."""
        self.strokes[:] = [stroke for stroke in self.strokes if stroke.erased is None]
        del self.grounds[:-1]
        if sum(len(stroke.points) for stroke in self.strokes) > _MOST_POINTS:
            for stroke in self.strokes:
                stroke.points[1:-1] = stroke.points[1:-1:2]
            if len(self.strokes) > _MOST_POINTS // 4:
                del self.strokes[: len(self.strokes) // 2]
