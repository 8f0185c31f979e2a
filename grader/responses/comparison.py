"""Compares numbers, and explains a wrong result by the formula that gives it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any


def same(value: Any, wanted: Any, tolerance: float = 1e-6) -> bool:
    """Return whether two numbers, or two sequences of numbers, differ by at most `tolerance` each.

    NaN is like nothing, and sequences of different lengths differ. Other values are compared by ==.
    """
    if isinstance(wanted, bool | str | bytes):
        return bool(value == wanted)
    if isinstance(wanted, Sequence):
        pairs = zip(value, wanted, strict=False)
        return len(value) == len(wanted) and all(same(a, b, tolerance) for a, b in pairs)
    return abs(value - wanted) <= tolerance


def text_of(value: Any) -> str:
    """Return a value as a score page shows it: numbers with three digits, texts in quotes."""
    if isinstance(value, float):
        return "NaN" if math.isnan(value) else f"{value:.3g}"
    return f"“{value[:60]}”" if isinstance(value, str) else str(value)


def first_matching(
    mistakes: Mapping[str, Sequence[Any]], values: Sequence[Any], tolerance: float = 1e-6
) -> str:
    """Return the hint of the first wrong formula that explains a series of values; "" if none does.

    mistakes: hint to the values that this formula would give, the likeliest first. A shorter series is
    compared with the beginning of the longer one.
    """
    for hint, wrong in mistakes.items():
        if values and all(same(a, b, tolerance) for a, b in zip(values, wrong, strict=False)):
            return hint
    return ""
