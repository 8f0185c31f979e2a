"""Compares numbers and points that a student's program sent: they may be NaN or infinite."""

import math
from collections.abc import Sequence


def is_near(value: float | Sequence[float], wanted: float | Sequence[float], tolerance: float) -> bool:
    """Return whether a number or a point is at most `tolerance` away from the right one.

    NaN and infinity are near nothing.
    """
    gap = math.dist(value, wanted) if isinstance(wanted, Sequence) else abs(value - wanted)
    return bool(gap <= tolerance)
