"""What a check is: a function over a recording, its points, and the way it says what was missed."""

from __future__ import annotations

import inspect
import math
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from sim.evidence import Recording, Seconds

Picture = str
"""How to show a miss: the run's "path", its "topics" over time, or a topic's numbers, by its name; or ""."""

Hints = Mapping[str, Callable[..., Any]]
"""A check's table of hints: each sentence with a function that tells whether its cause explains a miss.

The function is given the recording and what `Missed.about` holds; a row is left out where it takes another
number of arguments. It returns something false where the cause does not apply; or True, or a mapping with the
values for the sentence's {placeholders}.
"""


def otherwise(run: Recording, *about: Any) -> bool:
    """Return whether a miss is about something: the cause in the last row of a table of hints.

    So a miss that a shared measure raised, such as `publishes`, has its own hint or the diagnosis'.
    """
    return bool(about)


class Missed(Exception):
    """The student's node did not do what a check asks for.

    expected, saw: two short phrases that can be compared.
    hint: what to do next, where the cause is known. Left out, the first diagnosis that fits the recording
        takes its place, and after that the `guess`: what is most likely missing.
    about: what the check's table of hints is given to find the cause, such as a stimulus.
    credit: the fraction 0..1 of the check's points that is earned all the same.
    picture: of the recording, where a figure says more than words; see `Picture`.
    measured: with a credit, what checks that come after this one are handed.
    typo: a name that was misspelt, and the right one; or the type Float32 where Float64 is wanted, or
        the other way round.
    because: earlier checks of which one may be the cause; if one failed, the check is skipped, and not
        charged as a second mistake.
    unsafe: the robot did what may hurt a person: then the exercise gives no more than a part of its points.
    """

    def __init__(
        self,
        expected: str,
        saw: str,
        hint: str = "",
        *,
        guess: str = "",
        credit: float = 0.0,
        picture: Picture = "",
        measured: Any = None,
        typo: tuple[str, str] | None = None,
        unsafe: bool = False,
        because: tuple[Check, ...] = (),
        about: tuple[Any, ...] = (),
    ) -> None:
        super().__init__(f"expected {expected}; saw {saw}")
        self.expected, self.saw, self.hint, self.guess = expected, saw, hint, guess
        self.credit, self.picture, self.measured = fraction(credit), picture, measured
        self.typo, self.unsafe, self.about, self.because = typo, unsafe, about, because

    @property
    def begin(self) -> Seconds | None:
        """Return when the part of the run began that the check was judging; None for all of it."""
        frames = [frame for frame, _ in traceback.walk_tb(self.__traceback__)]
        looked_at = [
            value
            for frame in reversed(frames)
            for value in frame.f_locals.values()
            if isinstance(value, Recording)
        ]
        end = max((run.stamp for run in looked_at), default=0.0)
        parts = (run.begin for run in looked_at if run.begin > 0 or run.stamp < end)
        return next(parts, None)


@contextmanager
def hinting(hint: str = "", *, guess: str = "") -> Iterator[None]:
    """Give a miss in the block this hint, or this guess, unless it has one of its own."""
    try:
        yield
    except Missed as missed:
        missed.hint, missed.guess = missed.hint or hint, missed.guess or guess
        raise


@dataclass(frozen=True)
class Check:
    """One line of a score.

    sentence: what the student reads. after: the checks that it builds on: it is skipped when one of them
    earned nothing. only: names of the scenarios in which it holds; empty for all. guess: as in `Missed`, for
    any miss of this check; it may be a table. lasts: it speaks of all the time, as those do that build on
    others. hints: a table for a miss that has no hint of its own.
    """

    name: str
    sentence: str
    points: float
    after: tuple[Check, ...]
    function: Callable[..., Any]
    only: tuple[str, ...] = ()
    guess: str | Hints = field(default="", compare=False)
    lasts: bool = False
    hints: Hints = field(default_factory=dict, compare=False)

    def __call__(self, recording: Recording, *measured: Any) -> Any:
        """Return what the function measured. Raises Missed, or whatever a faulty check raises."""
        try:
            return self.function(recording, *measured)
        except Missed as missed:
            missed.hint = missed.hint or _first_fitting(self.hints, recording, missed)
            missed.guess = missed.guess or _first_fitting(self.guess, recording, missed)
            raise

    @property
    def takes_measured(self) -> int:
        """Return how many results of `after` the function takes: all of them, or none."""
        return len(inspect.signature(self.function).parameters) - 1

    def holds_in(self, scenario: str) -> bool:
        """Return whether it is judged in the scenario of this name."""
        return not self.only or scenario in self.only


def _first_fitting(table: str | Hints, recording: Recording, missed: Missed) -> str:
    """Return the first sentence of a table whose cause explains the miss, or ""; a text as it is."""
    if isinstance(table, str):
        return table
    for sentence, cause in table.items():
        found = _takes(cause, recording, *missed.about) and cause(recording, *missed.about)
        if found:
            return sentence.format(**found) if isinstance(found, Mapping) else sentence
    return ""


def new_check(
    function: Callable[..., Any],
    points: float,
    after: Check | tuple[Check, ...] = (),
    only: str | tuple[str, ...] = (),
    guess: str | Hints = "",
    lasts: bool = False,
    hints: Hints | None = None,
) -> Check:
    """A check of this function, whose docstring is the sentence that the student reads.

    The function takes a Recording, and after it, if it likes, what each of the checks in `after` has
    returned. It returns what it measured, if anything, or raises Missed.
    Raises ValueError for a function without a docstring, with other parameters, or for points that aren't a
    finite number from 0 up.
    """
    name = function.__name__
    if not (math.isfinite(points) and points >= 0):
        raise ValueError(f"points must be a finite number from 0 up, not {points!r}")
    sentence = " ".join((inspect.getdoc(function) or "").split("\n\n")[0].split())
    if not sentence:
        raise ValueError(f"{name} needs a docstring: it is the sentence that the student reads")
    before = (after,) if isinstance(after, Check) else tuple(after)
    places = (only,) if isinstance(only, str) else only
    whole = lasts or bool(before)
    made = Check(name, sentence, float(points), before, function, places, guess, whole, hints or {})
    if made.takes_measured not in (0, len(before)):
        raise ValueError(
            f"{name} takes a recording and nothing else, or also what each of its {len(before)} checks in "
            f"`after` has measured; it takes {made.takes_measured} more"
        )
    return made


def check(*, points: float, after: Check | tuple[Check, ...] = ()) -> Callable[[Callable[..., Any]], Check]:
    """Make a check of a function, as `new_check` does."""
    return lambda function: new_check(function, points, after)


def _takes(function: Callable[..., Any], *arguments: Any) -> bool:
    """Return whether a function can be called with these positional arguments."""
    try:
        inspect.signature(function).bind(*arguments)
    except TypeError:
        return False
    return True


def fraction(value: Any) -> float:
    """`value` as a fraction. Raises ValueError for anything else, True and False included."""
    number = math.nan if isinstance(value, bool) else float(value)
    if not 0.0 <= number <= 1.0:
        raise ValueError(f"a credit is the earned fraction, from 0 to 1; this one is {value!r}")
    return number


def tenths(credit: float) -> float:
    """Return a credit in whole tenths, from 0 to 1, so that points are easy to read."""
    return min(max(math.floor(credit * 10 + 1e-9) / 10, 0.0), 1.0)
