"""Nothing to judge: whose fault is it that nobody spoke?"""

from __future__ import annotations

from collections.abc import Iterable

from grader.checks.check import Missed
from sim.evidence import Endpoint, Recording


def silence(recording: Recording, expected: str, saw: str, speakers: Iterable[Endpoint]) -> Exception:
    """What to raise where a measure has nothing to look at.

    expected, saw: as in Missed. speakers: the ends that could have spoken. It is Missed where the run ended
    before ours had their say, or where none of these ends is ours; else our nodes were silent, or the check
    looks for what they never say: then a ValueError, which makes a broken check.
    """
    if recording.ended.reason != "time" and recording.ended.stamp < recording.seconds:
        return Missed(f"a run that lasts until there are {expected}", recording.ended.detail)
    if any(end.from_course for end in speakers):
        return ValueError(f"nodes of the exercise's own should have sent {expected}: {saw}")
    return Missed(expected, saw)
