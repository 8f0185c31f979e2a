"""From a recording to verdicts. Plain Python: no live node from here on."""

from __future__ import annotations

import traceback
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from grader.checks.check import Check, Missed, Picture
from grader.diagnosis import explain, find_fault
from grader.diagnosis.fault import Fault
from sim.evidence import Recording

Status = Literal["passed", "failed", "skipped", "broken"]

BROKEN_HINT = "Nothing to do: this check has a mistake of its own. Your instructor decides about its points."
EXPLAINED_BY_FAULT = "Not judged: the error above explains it."
EXPLAINED_BY_HINT = "Not judged: the hint above explains it."
CUT_SHORT = "hang", "livelock", "blocked"  # ends of a run before its time that are the student's


@dataclass(frozen=True)
class Verdict:
    """What became of one check.

    passed: all is well. failed: the student's node missed it. skipped: something above already explains it.
    broken: our own code raised, and `alarm` holds the traceback: an instructor decides about its points, for
    points that come by themselves would be a way to cheat.
    """

    name: str
    sentence: str
    points: float
    status: Status
    credit: float  # fraction 0..1 of the points
    expected: str = ""
    saw: str = ""
    hint: str = ""
    picture: Picture = ""
    alarm: str = ""
    run: int = 0  # index of the run it speaks of

    @property
    def earned(self) -> float:
        """Points."""
        return self.points * self.credit


def judge(checks: Sequence[Check], recording: Recording, scenario: str = "") -> list[Verdict]:
    """Judge every check that holds in this scenario, in order.

    The student's own error comes first and explains the checks that then miss. An error before the nodes were
    up leaves nothing to judge: everything is skipped.
    """
    court = _Court(recording)
    for item in checks:
        if item.holds_in(scenario):
            court.verdicts[item.name] = court.judge(item)
    return [*([faulty(court.fault)] if court.fault else []), *court.verdicts.values()]


def faulty(fault: Fault) -> Verdict:
    """The line that tells a student of an error of their own. It carries no points."""
    return Verdict("runs", fault.sentence, 0.0, "failed", 0.0, fault.expected, fault.saw, fault.hint)


def skipped(item: Check, reason: str) -> Verdict:
    """A verdict for a check that something above explains."""
    return Verdict(item.name, item.sentence, item.points, "skipped", 0.0, hint=reason)


def broken(item: Check, error: BaseException) -> Verdict:
    """A verdict for a check that could not be judged because of a mistake of ours."""
    alarm = "".join(traceback.format_exception(error))
    return Verdict(item.name, item.sentence, item.points, "broken", 0.0, hint=BROKEN_HINT, alarm=alarm)


class _Court:
    """Judges one recording, and remembers what is explained already: one mistake gives one red line."""

    def __init__(self, recording: Recording) -> None:
        self.recording = recording
        self.fault = find_fault(recording)
        self.verdicts: dict[str, Verdict] = {}
        self.measured: dict[str, Any] = {}
        self.explained: set[str] = set()

    def judge(self, item: Check) -> Verdict:
        if self.fault and self.fault.before_start:
            return skipped(item, EXPLAINED_BY_FAULT)
        judged = [before for before in item.after if before.name in self.verdicts]
        unmet = next((before for before in judged if self.verdicts[before.name].credit == 0.0), None)
        if unmet:
            return skipped(item, f"Not judged: first comes “{unmet.sentence}”")
        try:
            self.measured[item.name] = item(self.recording, *self._handed(item))
        except Missed as missed:
            if missed.measured is not None:
                self.measured[item.name] = missed.measured
            return self._missed(item, missed)
        except Exception as error:
            return broken(item, error)
        if item.after and self.share < 1.0:
            seen = f"Judged only for {self.recording.ended.stamp:.3g} s: the error above ended the run."
            return replace(skipped(item, seen), credit=self.share)
        return Verdict(item.name, item.sentence, item.points, "passed", 1.0)

    def _handed(self, item: Check) -> list[Any]:
        silent = [before.name for before in item.after if item.asks and before.name not in self.measured]
        if silent:
            raise ValueError(
                f"{silent[0]} missed without saying what it measured: {item.name} can't be judged"
            )
        return [self.measured[before.name] for before in item.after] if item.asks else []

    @property
    def share(self) -> float:
        """How much of its time the run had. Else who gets stuck at once has done nothing wrong."""
        ended, seconds = self.recording.ended, self.recording.seconds
        return ended.stamp / seconds if ended.reason in CUT_SHORT and seconds else 1.0

    def _missed(self, item: Check, missed: Missed) -> Verdict:
        cause = "" if missed.hint else explain(self.recording)
        if missed.credit == 0.0 and self.fault:
            return skipped(item, EXPLAINED_BY_FAULT)
        if missed.credit == 0.0 and cause in self.explained:
            return skipped(item, EXPLAINED_BY_HINT)
        if cause:
            self.explained.add(cause)
        return Verdict(
            item.name,
            item.sentence,
            item.points,
            "failed",
            missed.credit,
            missed.expected,
            missed.saw,
            missed.hint or cause or missed.guess or item.guess,
            missed.picture,
        )


_GRAVITY: dict[Status, int] = {"failed": 0, "skipped": 1, "broken": 2, "passed": 3}


def worst(checks: Sequence[Check], runs: Iterable[Sequence[Verdict]]) -> list[Verdict]:
    """One verdict per check out of several runs: a check holds only if it holds in all that judge it."""
    found: dict[str, list[Verdict]] = {}
    for index, verdicts in enumerate(runs):
        for verdict in verdicts:
            found.setdefault(verdict.name, []).append(replace(verdict, run=index))
    chosen = [min(group, key=lambda v: (v.credit, _GRAVITY[v.status])) for group in found.values()]
    order = ["runs", *(item.name for item in checks)]
    return sorted(chosen, key=lambda verdict: order.index(verdict.name))
