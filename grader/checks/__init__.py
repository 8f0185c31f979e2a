"""Checks, and the measures that authors of exercises build them from: plain Python over recordings."""

from grader.checks.check import Check, Missed, check
from grader.checks.judge import Verdict, judge
from grader.checks.logs import answers, logs
from grader.checks.motion import arrives, follows, keeps_clear, passes, stands_still, travelled
from grader.checks.nodes import has_timer, named, no_errors
from grader.checks.topics import publishes, rate, series, subscribes, within

__all__ = [
    "Check",
    "Missed",
    "Verdict",
    "answers",
    "arrives",
    "check",
    "follows",
    "has_timer",
    "judge",
    "keeps_clear",
    "logs",
    "named",
    "no_errors",
    "passes",
    "publishes",
    "rate",
    "series",
    "stands_still",
    "subscribes",
    "travelled",
    "within",
]
