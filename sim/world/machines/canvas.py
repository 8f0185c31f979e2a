"""The ground of a pond as pixels: what lies beneath a turtle. For pictures, `Drawing` keeps the lines."""

from __future__ import annotations

import numpy as np

from sim.world.drawing import Colour

PIXELS = 500  # in a row, and in a column
PER_METRE = 45
SIDE = float(np.float32(PIXELS - 1) / np.float32(PER_METRE))
"""Of a pond, m: from the middle of its first pixel to that of its last, as upstream rounds it."""
_DRAWN = 1 << 24  # marks a pixel on which a pen has been


class Canvas:
    """500 by 500 pixels, 45 in a metre."""

    def __init__(self) -> None:
        self._pixels = np.zeros((PIXELS, PIXELS), np.uint32)  # 0 where nothing is drawn

    def wipe(self) -> None:
        """Erase all that is drawn."""
        self._pixels[:] = 0

    def colour(self, x: float, y: float, ground: Colour) -> Colour:
        """The colour at a place (m); that of the ground where nobody has drawn."""
        value = int(self._pixels[_pixel(SIDE - y), _pixel(x)])
        return (value >> 16 & 255, value >> 8 & 255, value & 255) if value else ground

    def line(self, x0: float, y0: float, x1: float, y1: float, colour: Colour, width: int) -> None:
        """Draw from one place to another (m), with a square nib so many pixels wide."""
        value = _DRAWN | colour[0] << 16 | colour[1] << 8 | colour[2]
        column, row = _pixel(x0), _pixel(SIDE - y0)
        across, down = _pixel(x1) - column, _pixel(SIDE - y1) - row
        steps = max(abs(across), abs(down), 1)
        before = width // 2
        for step in range(steps + 1):
            left = column + round(across * step / steps) - before
            top = row + round(down * step / steps) - before
            self._pixels[max(top, 0) : top + width, max(left, 0) : left + width] = value


def clipped(x0: float, y0: float, x1: float, y1: float) -> tuple[float, float, float, float] | None:
    """The part of a line (m) that lies in the pond; None where there is none."""
    first, last = 0.0, 1.0
    for begin, way in ((x0, x1 - x0), (y0, y1 - y0)):
        if way == 0.0:
            if not 0.0 <= begin <= SIDE:
                return None
            continue
        enters, leaves = sorted((-begin / way, (SIDE - begin) / way))
        first, last = max(first, enters), min(last, leaves)
    if first > last:
        return None
    across, up = x1 - x0, y1 - y0
    return x0 + first * across, y0 + first * up, x0 + last * across, y0 + last * up


def _pixel(metres: float) -> int:
    return min(max(int(metres * PER_METRE + 0.5), 0), PIXELS - 1)
