"""How long a student's programs were at work: what ended, crashed, got stuck or hung earns no more time."""

from __future__ import annotations

import re
from typing import NamedTuple

from sim.evidence import Recording, Seconds

CUT_SHORT = "hang", "livelock", "blocked"  # ends of a run that are the student's
_WAITS = re.compile(r"has waited since t = (\S+) s")
LIVES = "A node lives as long as something keeps it spinning: rclpy.spin(node) returns only at shutdown."


class WorkTime(NamedTuple):
    """The part of a run's time, from 0 to 1, in which the student's programs were at work; why not all."""

    share: float
    why: str = ""


def worked_until(recording: Recording) -> Seconds:
    """Return when the last of the student's programs had ended or was stuck; else when the run ended."""
    ended = recording.ended
    waits = _WAITS.search(ended.detail) if ended.reason == "blocked" else None
    moments = [ended.stamp, recording.all_exited_at, float(waits[1]) if waits else None]
    return min(moment for moment in moments if moment is not None)


def work_of(recording: Recording, *, may_end: bool = False) -> WorkTime:
    """Return how much of its time a run has for the checks. may_end: a program that has ended may be done."""
    until, ended = worked_until(recording), recording.ended
    whole = ended.stamp if ended.reason in ("goal", "interrupted") else recording.seconds
    if until >= whole - 1e-6:
        return WorkTime(1.0)
    if ended.reason not in CUT_SHORT and (may_end or recording.all_exited_at is None):
        return WorkTime(1.0)
    if not (recording.errors or ended.reason in CUT_SHORT):
        return WorkTime(until / whole, f"{_for(until, whole)}: then your program had ended. {LIVES}")
    what = "nothing kept running" if ended.reason == "blocked" else "the error above ended it"
    return WorkTime(until / whole, f"{_for(until, whole)}: then {what}.")


def _for(until: Seconds, whole: Seconds) -> str:
    return f"Earned for {until:.3g} of {whole:.3g} s"
