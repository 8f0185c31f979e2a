"""Measures over log lines that the exercises of 01_nodes share."""

from __future__ import annotations

import itertools
import re
import statistics
from collections.abc import Iterable, Sequence

from grader.checks import Missed, logs
from grader.diagnosis.activity import slow_callback
from sim.recording import LogLine, Recording, Seconds

Found = tuple[LogLine, re.Match[str]]


def lines_like(recording: Recording, pattern: str, example: str, *, level: str = "") -> list[Found]:
    """The log lines that begin like a pattern, with the matches.

    example: such a line, for the reader. Raises Missed when there is none.
    """
    pattern = rf"^\W*?{pattern}"
    try:
        lines = logs(recording, pattern, level=level)
    except Missed as missed:
        expected = f"lines like “{example}”" + (f" at level {level}" if level else "")
        raise Missed(expected, missed.saw, missed.hint) from None
    return [(line, re.search(pattern, line.text, re.IGNORECASE)) for line in lines]


def come_every(recording: Recording, lines: Iterable[LogLine], period: Seconds) -> None:
    """The lines come one by one, from the start to the end of the run. Raises Missed with their real pace."""
    stamps = [line.stamp for line in lines]
    gaps = [after - before for before, after in itertools.pairwise(stamps)]
    even = all(abs(gap - period) <= 0.1 * period for gap in gaps)
    ends = stamps[0] <= 1.6 * period and recording.ended.stamp - stamps[-1] <= 1.6 * period
    if not (even and ends):
        hint = slow_callback(recording) or "The first argument of create_timer is the period in seconds."
        expected = f"a line every {period:g} s, from start to end"
        raise Missed(expected, _pace(stamps, gaps), hint if not even else slow_callback(recording))


def _pace(stamps: Sequence[Seconds], gaps: Sequence[Seconds]) -> str:
    if not gaps:
        return f"one line, at {stamps[0]:.3g} s"
    if max(gaps) < 1e-6:
        return f"{len(stamps)} lines at once, at {stamps[0]:.3g} s"
    if max(gaps) - min(gaps) > 1e-6:
        return f"pauses between {min(gaps):.3g} s and {max(gaps):.3g} s"
    return f"a line every {statistics.median(gaps):.3g} s, from {stamps[0]:.3g} s to {stamps[-1]:.3g} s"


def in_words(numbers: Sequence[int]) -> str:
    """The first numbers of a list, for the reader."""
    return ", ".join(map(str, numbers[:8])) + (", ..." if len(numbers) > 8 else "")
