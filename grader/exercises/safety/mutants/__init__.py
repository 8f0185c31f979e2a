"""Tests that pass what is right, and catch what is wrong."""

from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.safety.mutants.bench import ANSWER, FAILED, PASSED, QUESTION, VERDICT, bench
from grader.exercises.safety.mutants.speed_candidates import WRONG, candidates
from grader.exercises.safety.mutants.workshop import workshop
from sim.evidence import Recording

__all__ = ["bench", "mutants", "workshop"]

ENOUGH = 8  # of the wrong ones
THE_GIVEN = "Test the function that your test is given: call that one, not a copy of your own."
TOO_STRICT = ("Require no more than the contract does. Floats are rounded: compare with math.isclose(a, "
              "b, abs_tol=1e-3), or a <= b + 1e-3.")
NUMBERS = "std_msgs/msg/Float64MultiArray"

mutants = Exercise("mutants", "Tests that catch mutants", seconds=12, companions=workshop, seeds=(1, 2),
                   may_end=True)


class CandidateVerdict(NamedTuple):
    """The result of the tests on a candidate, and whether the candidate is right."""

    number: int
    passed: bool
    right: bool


@mutants.check(2)
def runs_the_tests(run: Recording) -> None:
    """The tests run, and call the candidates."""
    with hinting("" if run.errors else THE_GIVEN):
        subscribes(run, ANSWER, NUMBERS)
        publishes(run, QUESTION, NUMBERS)
    publishes(run, VERDICT, "std_msgs/msg/String")


@mutants.check(2, after=runs_the_tests)
def passes_what_is_right(run: Recording) -> list[CandidateVerdict]:
    """All three correct candidates pass, with tests that catch at least one of the others."""
    found = _verdicts(run)
    for one in found:
        if one.right and not one.passed:
            raise Missed(f"candidate {one.number} passing: it is right", "failed", TOO_STRICT)
    if all(one.passed for one in found):
        hint = "A test that asserts nothing passes everything. What must be true of the speed you get?"
        raise Missed("at least one of the ten wrong candidates to fail", "all passed", hint)
    return found


@mutants.check(16, after=passes_what_is_right)
def catches_what_is_wrong(run: Recording, found: list[CandidateVerdict]) -> None:
    """At least eight of the ten wrong candidates are caught."""
    caught = sum(not one.passed for one in found if not one.right)
    if caught < ENOUGH:
        hint = ("Go through the contract line by line: write a test for each line, with its own values: "
                "near, far, exactly on the edge, backwards, inf and nan, for both numbers. Too slow is "
                "wrong, "
                "too.")
        expected = f"{ENOUGH} or more of {WRONG} wrong candidates caught"
        raise Missed(expected, f"{caught}", hint, credit=caught / WRONG)


def _verdicts(run: Recording) -> list[CandidateVerdict]:
    """One for each candidate, in order. Raises Missed if one has none, or was never called."""
    truth = [right for right, _ in candidates(run.seed)]
    called = {int(row.message.data[0]) for row in run.messages(ANSWER) if row.from_course}
    published: dict[str, bool] = {}
    for row in run.messages(VERDICT):
        number, _, verdict = row.message.data.partition(" ")
        if verdict in (PASSED, FAILED):
            published.setdefault(number, verdict == PASSED)
    found = []
    for number, right in enumerate(truth, 1):
        if str(number) not in published:
            raise Missed(f"verdicts on {len(truth)} candidates", f"none on candidate {number}")
        found.append(CandidateVerdict(number, published[str(number)], right))
        if number not in called:
            raise Missed(f"questions to candidate {number}", "none", THE_GIVEN)
    return found
