"""Compares numbers and points that a student's program sent: they may be NaN or infinite."""

import math
from collections.abc import Sequence
from typing import cast


def is_near(value: float | Sequence[float], wanted: float | Sequence[float], tolerance: float) -> bool:
    """Return whether a number or a point is at most `tolerance` away from the right one.

    NaN and infinity are near nothing.
    """
    if isinstance(wanted, Sequence):
        return math.dist(cast("Sequence[float]", value), wanted) <= tolerance
    return bool(abs(cast("float", value) - wanted) <= tolerance)
