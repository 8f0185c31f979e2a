"""How a run ended, in a line or two for the student who is still writing the node."""

from __future__ import annotations

from grader.diagnosis import find_fault
from grader.diagnosis.fault import NOT_STARTED
from sim.recording import Recording

BEGIN = (
    "Not started yet: write your code where it says YOUR CODE HERE, delete the line that raises "
    "NotImplementedError, and run both cells again."
)


def tell(recording: Recording) -> None:
    """Print whether the run went well, or the first error with what to do about it. Gives no points."""
    fault = find_fault(recording)
    if fault is None:
        print(f"No error. {recording.ended.detail}")
    elif fault.sentence == NOT_STARTED:
        print(BEGIN)
    else:
        print(f"{fault.saw}\nHint: {fault.hint}")
