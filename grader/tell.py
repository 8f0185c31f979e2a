"""How a run ended, in a line or two for the student who is still writing the node."""

from __future__ import annotations

import textwrap

from grader.diagnosis import find_fault, find_flaw
from grader.diagnosis.fault import NOT_STARTED
from sim.evidence import Recording

WIDTH = 100  # characters: a notebook breaks longer lines within words
BEGIN = (
    "Not started yet: write your code where it says YOUR CODE HERE, delete the line that raises "
    "NotImplementedError, and run both cells again."
)


def tell(recording: Recording) -> None:
    """Print the most important thing that is wrong with a run, and what to do about it. Gives no points.

    An error, or a run that got stuck, goes before all else; then come causes why something does not work,
    such as names or QoS that don't match. A run without any of them is told that there is no error.
    """
    fault = find_fault(recording)
    if fault is None:
        _say(find_flaw(recording) or f"No error. {recording.ended.detail}")
    elif fault.sentence == NOT_STARTED:
        _say(BEGIN)
    else:
        _say(fault.saw)
        _say(f"Hint: {fault.hint}")


def _say(text: str) -> None:
    print(textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False))
