"""`tell`: prints the most important finding of the diagnosis of a run."""

from __future__ import annotations

import textwrap

from grader.diagnosis import find_fault, find_flaw
from grader.diagnosis.fault import NOT_STARTED
from sim.evidence import Recording
from sim.notebook import is_reported, name_cell

WIDTH = 100  # characters: a notebook breaks longer lines within words
BEGIN = (
    "Not started yet: write your code where it says YOUR CODE HERE, delete the line that raises "
    "NotImplementedError, and run both cells again."
)


def tell(recording: Recording) -> None:
    """Print the most important fault of a run and what to do about it. It gives no points.

    Errors and hanging runs have priority, then causes why something does not work, such as names or QoS that
    don't match. Without a fault it prints that there is no error. A failure that `run` has shown in the same
    cell is not repeated.
    """
    lines = explain_failure(recording)
    if not lines:
        _print(find_flaw(recording) or f"No error. {recording.ended.detail}")
    elif not is_reported(recording):
        for line in lines:
            _print(name_cell(line, recording))


def explain_failure(recording: Recording) -> list[str]:
    """The first error in the student's programs, or why they got stuck, and the hint; empty if none."""
    fault = find_fault(recording)
    if fault is None:
        return []
    if fault.sentence == NOT_STARTED:
        return [BEGIN]
    return [fault.saw, *([f"Hint: {fault.hint}"] if fault.hint else [])]


def _print(text: str) -> None:
    print(textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False))
