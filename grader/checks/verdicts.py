"""From a recording to verdicts. Plain Python: no live node from here on."""

from __future__ import annotations

import math
import traceback
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from grader.checks.check import Check, Missed, Picture
from grader.checks.staging import evidence_of
from grader.checks.work import work_of
from grader.diagnosis import explain, find_fault
from grader.diagnosis.fault import Fault
from grader.diagnosis.owners import LEAVE_IT, Intrusion, intrusions
from sim.evidence import Recording

Status = Literal["passed", "failed", "skipped", "broken"]
WORST_FIRST: tuple[Status, ...] = ("failed", "skipped", "broken", "passed")  # where the credit is the same

BROKEN_HINT = "Nothing for you to do: this check itself has a bug. Your instructor decides on its points."
FIX_FIRST = "Not graded yet: fix this first: “{}”"
EXPLAINED_BY_FAULT = "Not graded: the error above explains it."
EXPLAINED_BY_SPOOFING = "Not graded: it isn't clear which program sent what; see above."
EXPLAINED_BY_HINT = "Not graded: the hint above explains it."
SPOOFED_TOPICS = "keeps_apart"  # the name of the line about a topic or service with two owners


@dataclass(frozen=True)
class Verdict:
    """The outcome of one check.

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
    unsafe: bool = False  # as in Missed
    typo: tuple[str, str] | None = None  # as in Missed
    begin: float | None = None  # as in Missed

    @property
    def earned(self) -> float:
        """Points, in halves: rounded down."""
        return halves(self.points * self.credit) if self.credit < 1.0 else self.points


def halves(points: float) -> float:
    """Points as a person would write them: whole and half ones, never more than were earned."""
    return math.floor(points * 2 + 1e-6) / 2


def judge(
    checks: Sequence[Check], recording: Recording, scenario: str = "", *, may_end: bool = False
) -> list[Verdict]:
    """Judge every check that holds in this scenario, in order. may_end: as in Exercise.

    The student's own error comes first and explains the checks that then miss. An error before the nodes were
    up leaves nothing to judge: everything is skipped.
    """
    judging = _Judging(recording, may_end)
    for item in checks:
        if item.holds_in(scenario):
            judging.verdicts[item.name] = judging.judge(item)
    first = [faulty(judging.fault)] if judging.fault else []
    first += [_spoofed(found) for found in judging.intrusions[:1]]
    return [*first, *judging.verdicts.values()]


def faulty(fault: Fault) -> Verdict:
    """The line that tells a student of an error of their own. It carries no points."""
    return Verdict("runs", fault.sentence, 0.0, "failed", 0.0, fault.expected, fault.saw, fault.hint)


def _spoofed(found: Intrusion) -> Verdict:
    """The line that tells a student of an end where only another program has one. It carries no points."""
    return Verdict(
        SPOOFED_TOPICS,
        "The node leaves topics and services of other programs alone.",
        0.0,
        "failed",
        0.0,
        f"one {found.what} {found.name}: {found.owner}",
        f"two, {found.owner} and {found.student} of yours",
        LEAVE_IT,
    )


def skipped(item: Check, reason: str) -> Verdict:
    """A verdict for a check that something above explains."""
    return Verdict(item.name, item.sentence, item.points, "skipped", 0.0, hint=reason)


def broken(item: Check, error: BaseException) -> Verdict:
    """A verdict for a check that could not be judged because of a mistake in the course."""
    alarm = "".join(traceback.format_exception(error))
    return Verdict(item.name, item.sentence, item.points, "broken", 0.0, hint=BROKEN_HINT, alarm=alarm)


class _Judging:
    """Judges one recording, and remembers what is explained already: one mistake gives one red line."""

    def __init__(self, recording: Recording, may_end: bool) -> None:
        self.recording, self.evidence = recording, evidence_of(recording)
        self.work = work_of(recording, may_end=may_end)
        self.fault, self.intrusions = find_fault(recording), intrusions(recording)
        self.verdicts: dict[str, Verdict] = {}
        self.measured: dict[str, Any] = {}
        self.explained: set[str] = set()

    def judge(self, item: Check) -> Verdict:
        if self.fault and self.fault.before_start:
            return skipped(item, EXPLAINED_BY_FAULT)
        judged = [before for before in item.after if before.name in self.verdicts]
        unmet = next((before for before in judged if self.verdicts[before.name].credit == 0.0), None)
        if unmet:
            return skipped(item, FIX_FIRST.format(unmet.sentence))
        if item.after and self.intrusions:
            return skipped(item, EXPLAINED_BY_SPOOFING)
        try:
            self.measured[item.name] = item(self.evidence, *self._handed(item))
        except Missed as missed:
            if missed.measured is not None:
                self.measured[item.name] = missed.measured
            return self._missed(item, missed)
        except Exception as error:
            return broken(item, error)
        if item.lasts and self.work.share < 1.0:
            return replace(skipped(item, self.work.why), credit=self.work.share)
        return Verdict(item.name, item.sentence, item.points, "passed", 1.0)

    def _handed(self, item: Check) -> list[Any]:
        unmeasured = [
            before.name for before in item.after if item.takes_measured and before.name not in self.measured
        ]
        if unmeasured:
            raise ValueError(
                f"{unmeasured[0]} missed without saying what it measured: {item.name} can't be judged"
            )
        return [self.measured[before.name] for before in item.after] if item.takes_measured else []

    def _missed(self, item: Check, missed: Missed) -> Verdict:
        for other in missed.because:
            if other.name in self.verdicts and self.verdicts[other.name].status == "failed":
                return skipped(item, FIX_FIRST.format(self.verdicts[other.name].sentence))
        cause = "" if missed.hint else explain(self.recording)
        if missed.credit == 0.0 and self.fault and not missed.unsafe:
            return replace(skipped(item, EXPLAINED_BY_FAULT), typo=missed.typo)
        if missed.credit == 0.0 and cause in self.explained and not missed.unsafe:
            return skipped(item, EXPLAINED_BY_HINT)
        if cause:
            self.explained.add(cause)
        return Verdict(
            item.name,
            item.sentence,
            item.points,
            "failed",
            missed.credit * (self.work.share if item.lasts else 1.0),
            missed.expected,
            missed.saw,
            missed.hint or cause or missed.guess,
            missed.picture,
            unsafe=missed.unsafe,
            typo=missed.typo,
            begin=missed.begin,
        )


def rank(verdict: Verdict) -> tuple[bool, float, int]:
    """Its place among verdicts on the same check: of several runs, the first in this order is shown.

    One of a robot that was unsafe goes before all, and earns no more.
    """
    return not verdict.unsafe, verdict.credit, WORST_FIRST.index(verdict.status)


def _worst_of(group: Sequence[Verdict]) -> Verdict:
    shown = min(group, key=rank)
    return replace(shown, credit=min(verdict.credit for verdict in group))


def worst(checks: Sequence[Check], runs: Iterable[Sequence[Verdict]]) -> list[Verdict]:
    """One verdict per check out of several runs: a check holds only if it holds in all that judge it."""
    found: dict[str, list[Verdict]] = {}
    for index, verdicts in enumerate(runs):
        for verdict in verdicts:
            found.setdefault(verdict.name, []).append(replace(verdict, run=index))
    chosen = [_worst_of(group) for group in found.values()]
    order = ["runs", SPOOFED_TOPICS, *(item.name for item in checks)]
    return sorted(chosen, key=lambda verdict: order.index(verdict.name))
