"""How a run ended, in a line or two for the student who is still writing the node."""

from __future__ import annotations

import textwrap

from grader.diagnosis import find_fault
from grader.diagnosis.fault import NOT_STARTED
from sim.recording import Recording

WIDTH = 100  # characters: a notebook breaks longer lines within words
BEGIN = (
    "Not started yet: write your code where it says YOUR CODE HERE, delete the line that raises "
    "NotImplementedError, and run both cells again."
)


def tell(recording: Recording) -> None:
    """Print whether the run went well, or the first error with what to do about it. Gives no points."""
    fault = find_fault(recording)
    if fault is None:
        _say(f"No error. {recording.ended.detail}")
    elif fault.sentence == NOT_STARTED:
        _say(BEGIN)
    else:
        _say(fault.saw)
        _say(f"Hint: {fault.hint}")


def _say(text: str) -> None:
    print(textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False))
