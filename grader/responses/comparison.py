"""Compares numbers and series of numbers, and writes them as score pages do."""

import math
import re
from collections.abc import Sequence
from typing import Any

from grader.geometry.near import is_near

MOST_NUMBERS = 5  # in a text that states one


def same(value: Any, wanted: Any, tolerance: float = 1e-6) -> bool:
    """Return whether two numbers, or two sequences of numbers, differ by at most `tolerance` each.

    NaN is like nothing, and sequences of different lengths differ. Other values are compared by ==.
    """
    if isinstance(wanted, bool | str | bytes):
        return bool(value == wanted)
    if isinstance(wanted, Sequence):
        pairs = zip(value, wanted, strict=False)
        return len(value) == len(wanted) and all(same(a, b, tolerance) for a, b in pairs)
    return is_near(value, wanted, tolerance)


def numbers_in(text: str) -> list[float]:
    """Return the numbers in a text."""
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


def states(text: str, *wanted: float, tolerance: float = 0.0) -> bool:
    """Return whether a text states one of these numbers, and not so many others that it states nothing."""
    numbers = numbers_in(text)
    near = (is_near(number, right, tolerance) for number in numbers for right in wanted)
    return len(numbers) <= MOST_NUMBERS and any(near)


def text_of(value: Any) -> str:
    """Return a value as a score page shows it: numbers with three digits, texts in quotes."""
    if isinstance(value, float):
        return "NaN" if math.isnan(value) else f"{value:.3g}"
    return f"“{value[:60]}”" if isinstance(value, str) else str(value)


def listed(values: Sequence[float], most: int = 9) -> str:
    """Return numbers as a score page lists them; after the first ones, how many more there are."""
    shown = ", ".join(f"{value:g}" for value in values[:most])
    return f"{shown}, and {len(values) - most} more" if len(values) > most else shown


def matches(values: Sequence[Any], wanted: Sequence[Any], tolerance: float = 1e-6) -> bool:
    """Return whether two series have the same values, as far as the shorter one goes.

    An empty series matches nothing. In a table of hints, `wanted` is what a wrong formula gives.
    """
    pairs = list(zip(values, wanted, strict=False))
    return bool(pairs) and all(same(a, b, tolerance) for a, b in pairs)
