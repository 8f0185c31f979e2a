"""What a student's own error looks like once it is put into words."""

from dataclasses import dataclass

NOT_STARTED = "There is code to run."


@dataclass(frozen=True)
class Fault:
    """An error, hang or the like in the student's code.

    sentence: what should be the case.
    before_start: no node was up yet, so there is nothing to judge.
    """

    expected: str
    saw: str
    hint: str
    before_start: bool = False
    sentence: str = "Your code runs without an error."
