"""Measures over log lines that the exercises of 01_nodes share."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Sequence

from grader.checks import Missed, logs
from grader.diagnosis.activity import slow_callback
from sim.recording import LogLine, Recording, Seconds

Found = tuple[LogLine, re.Match[str]]

MISSING = "Compare the two lines. And does anything call the method that should log it?"


def lines_like(
    recording: Recording, pattern: str, example: str, *, level: str = "", hint: str = MISSING
) -> list[Found]:
    """The log lines that begin like a pattern, with the matches.

    example: such a line, for the reader. Raises Missed when there is none, with `hint` if nothing is known
    that fits better.
    """
    pattern = rf"^\W*?{pattern}"
    try:
        lines = logs(recording, pattern, level=level, example=example)
    except Missed as missed:
        if missed.hint or not recording.logs:
            raise
        raise Missed(missed.expected, missed.saw, hint) from None
    return [(line, re.search(pattern, line.text, re.IGNORECASE)) for line in lines]


def come_every(
    recording: Recording, lines: Iterable[LogLine], period: Seconds, *, credit: float = 0.0
) -> None:
    """The lines come one by one, from the start to the end of the run.

    Raises Missed with their real pace; `credit` is what is earned all the same.
    """
    stamps = [line.stamp for line in lines]
    gaps = [after - before for before, after in itertools.pairwise(stamps)]
    even = bool(gaps) and all(abs(gap - period) <= 0.1 * period for gap in gaps)
    late, early = stamps[0] > 1.6 * period, recording.ended.stamp - stamps[-1] > 1.6 * period
    if even and not late and not early:
        return
    if even:
        moment = stamps[0] if late else stamps[-1]
        hint = f"What changes at {moment:.3g} s?"
    elif recording.graph.timers:
        hint = "One timer sets the pace, its period in seconds. Log one line each time its method is called."
    else:
        hint = "The node has no timer: create_timer(period, method) has a method called again and again."
    expected = f"a line every {period:g} s, from start to end"
    raise Missed(expected, _pace(stamps, gaps), slow_callback(recording) or hint, credit=credit)


def _pace(stamps: Sequence[Seconds], gaps: Sequence[Seconds]) -> str:
    if not gaps:
        return f"one line, at {stamps[0]:.3g} s"
    if max(gaps) < 1e-6:
        return f"{len(stamps)} lines at once, at {stamps[0]:.3g} s"
    if max(gaps) - min(gaps) > 1e-6:
        return f"pauses between {min(gaps):.3g} s and {max(gaps):.3g} s"
    return f"a line every {gaps[0]:.3g} s, from {stamps[0]:.3g} s to {stamps[-1]:.3g} s"


def in_words(numbers: Sequence[int]) -> str:
    """The first numbers of a list, for the reader."""
    return ", ".join(map(str, numbers[:8])) + (", ..." if len(numbers) > 8 else "")
