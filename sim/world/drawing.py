"""What pens drew on the ground of a world: lines whose points have stamps, so that a replay draws, too."""

from __future__ import annotations

import bisect
from collections.abc import Iterator
from dataclasses import dataclass, field

Colour = tuple[int, int, int]
"""Red, green and blue, each from 0 to 255."""
_MOST_POINTS = 20_000  # of a drawing without an end


@dataclass(slots=True)
class Stroke:
    """One line of a pen, without a gap: its colour and width (m), and points (stamp, x, y) in s and m.

    pen: the name of the body whose pen it is. erased: when somebody wiped it off (s), or None.
    """

    pen: str
    colour: Colour
    width: float
    points: list[tuple[float, float, float]] = field(default_factory=list)
    erased: float | None = None

    def is_there(self, stamp: float) -> bool:
        """Whether some of it can be seen at `stamp` (s)."""
        return self.points[0][0] <= stamp and (self.erased is None or stamp < self.erased)

    def until(self, stamp: float) -> list[tuple[float, float]]:
        """The points (x, y) that were drawn up to `stamp` (s)."""
        last = bisect.bisect_right(self.points, stamp + 1e-6, key=lambda point: point[0])
        return [point[1:] for point in self.points[:last]]


@dataclass(slots=True)
class Drawing:
    """All that was ever drawn, oldest first, and the colours of the ground, each from a stamp (s) on."""

    strokes: list[Stroke] = field(default_factory=list)
    grounds: list[tuple[float, Colour]] = field(default_factory=list)

    @property
    def ground(self) -> Colour:
        """The colour that the ground has now."""
        return self.grounds[-1][1]

    def ground_at(self, stamp: float) -> Colour:
        """The colour that the ground had at `stamp` (s)."""
        return next(
            (colour for since, colour in reversed(self.grounds) if since <= stamp), self.grounds[0][1]
        )

    def paint(self, stamp: float, colour: Colour) -> None:
        """Give the ground another colour from `stamp` (s) on."""
        if not self.grounds or colour != self.ground:
            self.grounds.append((stamp, colour))

    def at(self, stamp: float) -> Iterator[tuple[Stroke, list[tuple[float, float]]]]:
        """The strokes that can be seen at `stamp` (s), each with its points up to then."""
        return ((stroke, stroke.until(stamp)) for stroke in self.strokes if stroke.is_there(stamp))

    def wipe(self, stamp: float) -> None:
        """Erase all that is there."""
        for stroke in self.strokes:
            if stroke.erased is None:
                stroke.erased = stamp

    def forget(self) -> None:
        """Keep what can be seen, and of that so many points; for a run without an end."""
        self.strokes[:] = [stroke for stroke in self.strokes if stroke.erased is None]
        del self.grounds[:-1]
        if sum(len(stroke.points) for stroke in self.strokes) > _MOST_POINTS:
            for stroke in self.strokes:
                stroke.points[1:-1] = stroke.points[1:-1:2]
            if len(self.strokes) > _MOST_POINTS // 4:
                del self.strokes[: len(self.strokes) // 2]
