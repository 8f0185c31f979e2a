"""What a check is: a function over a recording, its points, and the way it says what was missed."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from sim.recording import Recording

Picture = Literal["", "path", "topics"]


class Missed(Exception):
    """The student's node did not do what a check asks for.

    expected, saw: two short phrases that can be compared.
    hint: what to do next; left out, the first diagnosis that fits the recording takes its place.
    credit: the fraction 0..1 of the check's points that is earned all the same.
    picture: "path" or "topics" where a figure of the recording says more than words.
    """

    def __init__(
        self, expected: str, saw: str, hint: str = "", *, credit: float = 0.0, picture: Picture = ""
    ) -> None:
        super().__init__(f"expected {expected}; saw {saw}")
        self.expected, self.saw, self.hint = expected, saw, hint
        self.credit, self.picture = fraction(credit), picture


@dataclass(frozen=True)
class Check:
    """One line of a score.

    `sentence` is what the student reads. The check is skipped when one of `after` earned nothing.
    """

    name: str
    sentence: str
    points: float
    after: tuple[Check, ...]
    function: Callable[[Recording], Any]

    def __call__(self, recording: Recording) -> float:
        """The fraction 0..1 that is earned. Raises Missed, or whatever a faulty check raises."""
        result = self.function(recording)
        return 1.0 if result is None else fraction(result)


def check(*, points: float, after: Check | tuple[Check, ...] = ()) -> Callable[[Callable], Check]:
    """Make a check of a function whose docstring is the sentence that the student reads.

    The function takes a Recording. It returns nothing when all is well, or the earned fraction 0..1, or
    raises Missed.
    Raises ValueError for a function without a docstring, or points that aren't a finite number from 0 up.
    """
    if not (math.isfinite(points) and points >= 0):
        raise ValueError(f"points must be a finite number from 0 up, not {points!r}")

    def decorate(function: Callable[[Recording], Any]) -> Check:
        sentence = " ".join((inspect.getdoc(function) or "").split("\n\n")[0].split())
        if not sentence:
            raise ValueError(
                f"{function.__name__} needs a docstring: it is the sentence that the student reads"
            )
        before = (after,) if isinstance(after, Check) else tuple(after)
        return Check(function.__name__, sentence, float(points), before, function)

    return decorate


def fraction(value: Any) -> float:
    """`value` as a fraction. Raises ValueError for anything else, True and False included."""
    number = math.nan if isinstance(value, bool) else float(value)
    if not 0.0 <= number <= 1.0:
        raise ValueError(
            f"a check returns nothing, or the earned fraction from 0 to 1; this one returned {value!r}"
        )
    return number
