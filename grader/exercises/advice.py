"""Hints of an exercise's own, for misses that nothing else explains."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from grader.checks import Missed
from grader.diagnosis import explain
from sim.recording import Recording


@contextmanager
def advising(recording: Recording, hint: str) -> Iterator[None]:
    """Give a miss in the block this hint, unless it has one or a diagnosis fits the recording."""
    try:
        yield
    except Missed as missed:
        if missed.hint or explain(recording):
            raise
        raise Missed(
            missed.expected, missed.saw, hint, credit=missed.credit, picture=missed.picture
        ) from None
