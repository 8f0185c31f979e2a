"""What to raise when a check has nothing to judge."""

from __future__ import annotations

from collections.abc import Iterable

from grader.checks.check import Missed
from sim.evidence import Endpoint, Recording


def no_data(recording: Recording, expected: str, saw: str, senders: Iterable[Endpoint]) -> Exception:
    """Return the exception to raise when a measure finds no data.

    expected, saw: as in Missed. senders: the endpoints that could have sent it. It is Missed if the run ended
    early, or if no program of the course is among the senders. Otherwise the course's programs sent nothing,
    or the check looks for what they never send: a ValueError, which makes the check broken.
    """
    if recording.ended.reason != "time" and recording.ended.stamp < recording.seconds:
        return Missed(f"a run that lasts until there are {expected}", recording.ended.detail)
    if any(end.from_course for end in senders):
        return ValueError(f"nodes of the exercise's own should have sent {expected}: {saw}")
    return Missed(expected, saw)
