"""Angles in degrees: turns between directions."""

import math
from collections.abc import Sequence


def turn_between(one: float, other: float) -> float:
    """Return how far one direction is to the left of another, -180 to 180; infinity for NaN or infinity."""
    return math.remainder(one - other, 360.0) if math.isfinite(one - other) else math.inf


def least_turn(direction: float, others: Sequence[float]) -> float:
    """Return the angle between a direction and the nearest of others, 0 to 180."""
    return min(abs(turn_between(direction, other)) for other in others)
