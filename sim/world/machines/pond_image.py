"""The ground of a pond as pixels, for the turtles' color sensors; pictures use `PenDrawing`."""

from __future__ import annotations

import numpy as np

from sim.world.pen_drawing import Color

PIXELS = 500  # per row and per column
PER_METER = 45
SIDE = float(np.float32(PIXELS - 1) / np.float32(PER_METER))
"""Side length of a pond, m: from the center of the first pixel to that of the last, as in turtlesim."""
_DRAWN = 1 << 24  # flag of a pixel with pen color


class PondImage:
    """500 by 500 pixels, 45 in a meter."""

    def __init__(self) -> None:
        self._pixels = np.zeros((PIXELS, PIXELS), np.uint32)  # 0: nothing drawn

    def erase(self) -> None:
        """Erase everything drawn."""
        self._pixels[:] = 0

    def color(self, x: float, y: float, ground: Color) -> Color:
        """The color at a position (m): of the pen, or of the ground."""
        value = int(self._pixels[_pixel(SIDE - y), _pixel(x)])
        return (value >> 16 & 255, value >> 8 & 255, value & 255) if value else ground

    def line(self, x0: float, y0: float, x1: float, y1: float, color: Color, width: int) -> None:
        """Draw a line (m) with a square pen, `width` in pixels."""
        value = _DRAWN | color[0] << 16 | color[1] << 8 | color[2]
        column, row = _pixel(x0), _pixel(SIDE - y0)
        across, down = _pixel(x1) - column, _pixel(SIDE - y1) - row
        steps = max(abs(across), abs(down), 1)
        before = width // 2
        for step in range(steps + 1):
            left = column + round(across * step / steps) - before
            top = row + round(down * step / steps) - before
            self._pixels[max(top, 0) : top + width, max(left, 0) : left + width] = value


def clipped(x0: float, y0: float, x1: float, y1: float) -> tuple[float, float, float, float] | None:
    """The part of a line (m) inside the pond; None if it is outside."""
    first, last = 0.0, 1.0
    for begin, extent in ((x0, x1 - x0), (y0, y1 - y0)):
        if extent == 0.0:
            if not 0.0 <= begin <= SIDE:
                return None
            continue
        enters, leaves = sorted((-begin / extent, (SIDE - begin) / extent))
        first, last = max(first, enters), min(last, leaves)
    if first > last:
        return None
    across, up = x1 - x0, y1 - y0
    return x0 + first * across, y0 + first * up, x0 + last * across, y0 + last * up


def _pixel(meters: float) -> int:
    return min(max(int(meters * PER_METER + 0.5), 0), PIXELS - 1)
