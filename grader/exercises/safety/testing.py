"""An exercise on tests: they pass what is right, and catch what is wrong."""

from __future__ import annotations

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.safety.bench import ANSWER, FAILED, PASSED, QUESTION, VERDICT, workshop
from grader.exercises.safety.candidates import WRONG, candidates
from sim.evidence import Recording

ENOUGH = 8  # of the wrong ones
NO_END = "A test came to no end: it may ask for long, but not for ever, and it needs no sleep."
THE_GIVEN = "The function that a test is given is the one to test: call that one, and no copy of yours."
TOO_STRICT = (
    "Ask no more than the contract says. Floats are rounded: compare with math.isclose(a, b, abs_tol=1e-3), "
    "or a <= b + 1e-3."
)
NUMBERS = "std_msgs/msg/Float64MultiArray"

mutants = Exercise(
    "mutants", "Tests that catch mutants", seconds=12, companions=workshop, seeds=(1, 2), may_end=True
)


class Verdict(NamedTuple):
    """What the tests said of a candidate, and what is true of it."""

    number: int
    passed: bool
    right: bool


@mutants.check(2)
def runs_the_tests(run: Recording) -> None:
    """The tests are run, and ask the candidates."""
    with hinting("" if run.errors else THE_GIVEN):
        subscribes(run, ANSWER, NUMBERS)
        publishes(run, QUESTION, NUMBERS)
    with hinting(guess=NO_END):
        publishes(run, VERDICT, "std_msgs/msg/String")


@mutants.check(2, after=runs_the_tests)
def passes_what_is_right(run: Recording) -> list[Verdict]:
    """All three right candidates pass, by tests that catch at least one of the others."""
    found = _verdicts(run)
    for one in found:
        if one.right and not one.passed:
            raise Missed(f"candidate {one.number} passing: it is right", "failed", TOO_STRICT)
    if all(one.passed for one in found):
        hint = "A test that asserts nothing passes everything. What must hold of the speed you get?"
        raise Missed("a candidate that fails, of ten wrong ones", "all passed", hint)
    return found


@mutants.check(16, after=passes_what_is_right)
def catches_what_is_wrong(run: Recording, found: list[Verdict]) -> None:
    """At least eight of the ten wrong candidates are caught."""
    caught = sum(not one.passed for one in found if not one.right)
    if caught < ENOUGH:
        hint = (
            "Go through the contract line by line: each line is a test, and each needs its own places. Near, "
            "far, just on the edge, backwards, inf and nan, for both numbers. Too slow is wrong, too."
        )
        raise Missed(
            f"{ENOUGH} or more of {WRONG} wrong candidates caught", f"{caught}", hint, credit=caught / WRONG
        )


def _verdicts(run: Recording) -> list[Verdict]:
    """One for each candidate, in order. Raises Missed where one is left out, or was never asked."""
    truth = [right for right, _ in candidates(run.seed)]
    asked = {int(heard.message.data[0]) for heard in run.messages(ANSWER) if heard.from_course}
    said: dict[str, bool] = {}
    for heard in run.messages(VERDICT):
        number, _, word = heard.message.data.partition(" ")
        if word in (PASSED, FAILED):
            said.setdefault(number, word == PASSED)
    found = []
    for number, right in enumerate(truth, 1):
        if str(number) not in said:
            saw = f"none on candidate {number}"
            raise Missed(f"a verdict on each of {len(truth)} candidates", saw, guess=NO_END)
        found.append(Verdict(number, said[str(number)], right))
        if number not in asked:
            raise Missed(f"questions to candidate {number}", "none", THE_GIVEN)
    return found
