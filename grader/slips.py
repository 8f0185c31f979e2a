"""Slips of a number's type and of a name: what the program would have done without is worth half."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from grader.checks.judge import Verdict
from sim import Process
from sim.evidence import Recording

WORTH = 0.5  # of the points
WHOLE_NUMBERS = "whole numbers"
MENDED = "Judged as if the slip above were mended, for half of the points."
# Of an action; rcl maps them one by one.
_PARTS = "send_goal", "cancel_goal", "get_result", "feedback", "status"
_OF_A_NUMBER = re.compile(r"The '\w+' field must be of type '(float|int)'")


def slips_of(recording: Recording, verdicts: Sequence[Verdict]) -> list[str]:
    """What `mended` has to mend, for the slips that a run and its verdicts show."""
    names = [f"{wrong}:={right}" for wrong, right in filter(None, (verdict.slip for verdict in verdicts))]
    errors = [error for error in recording.errors if error.type == "AssertionError"]
    numbers = any(_OF_A_NUMBER.search(error.text) for error in errors)
    return [*dict.fromkeys(names), *([WHOLE_NUMBERS] if numbers else [])]


def mended(program: Any, *slips: str) -> Process:
    """A student's program without these slips."""
    process = program if isinstance(program, Process) else Process(program)
    names = [slip.split(":=") for slip in slips if slip != WHOLE_NUMBERS]
    rules = [(wrong, right) for wrong, right in names]
    rules += [
        (f"{wrong}/_action/{part}", f"{right}/_action/{part}")
        for wrong, right in names
        if wrong.startswith("/")
        for part in _PARTS
    ]
    remappings = [*process.remappings, *rules]
    return replace(process, remappings=remappings, whole_numbers=WHOLE_NUMBERS in slips)


def with_half(given: Sequence[Verdict], without: Sequence[Verdict]) -> list[Verdict]:
    """The verdicts on a program, with half of what it earns without its slips where that is more."""
    again = {verdict.name: verdict for verdict in without}
    return [_better(verdict, again.get(verdict.name)) for verdict in given]


def _better(given: Verdict, without: Verdict | None) -> Verdict:
    if without is None or not given.points:
        return given
    credit = WORTH * without.credit
    if credit <= given.credit and not without.unsafe:
        return given
    if given.status == "failed":
        return replace(given, credit=max(credit, given.credit), unsafe=given.unsafe or without.unsafe)
    if without.status == "failed":
        return replace(without, credit=max(credit, given.credit), picture="")
    return replace(given, status="skipped", credit=credit, hint=MENDED)
