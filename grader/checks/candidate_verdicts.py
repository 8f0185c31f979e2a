"""What a package's tests did on its own file, and on right and wrong ones in place of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from grader.checks.check import Missed
from grader.companions.test_runner import OWN, PASSED, VERDICTS
from sim.evidence import Recording

NOTHING_FOUND = "NO_TESTS_COLLECTED"  # pytest's name for it, in a verdict


class TestVerdict(NamedTuple):
    """The outcome of the tests on a candidate. tests: how many ran. failed: what failed."""

    name: str
    passed: bool
    tests: int
    failed: str


def own_verdict(run: Recording, file: str) -> TestVerdict:
    """The verdict on the package as it is. Raises Missed, about the verdict, if no test ran or one failed.

    file: the candidate that the package has, for the message.
    """
    own = _verdicts(run)[OWN]
    if not own.passed or not own.tests:
        saw = "no test" if own.failed in ("", NOTHING_FOUND) else own.failed
        raise Missed(f"tests that pass on {file}", saw, about=(own,))
    return own


def candidate_verdicts(
    run: Recording, truth: Sequence[tuple[bool, str]], hint: str
) -> list[tuple[bool, TestVerdict]]:
    """Whether a candidate is right, and the verdict on it. Raises Missed, with the hint, if one has none."""
    found = _verdicts(run)
    for number in range(1, len(truth) + 1):
        if str(number) not in found:
            raise Missed(f"verdicts on {len(truth)} candidates", f"none on candidate {number}", hint)
    return [(right, found[str(number)]) for number, (right, _) in enumerate(truth, 1)]


def _verdicts(run: Recording) -> dict[str, TestVerdict]:
    """The first verdict on each candidate, by its name."""
    found: dict[str, TestVerdict] = {}
    for row in run.messages(VERDICTS):
        name, outcome, tests, failed = [*row.message.data.split(" ", 3), "", "", ""][:4]
        number = int(tests) if tests.isdigit() else 0
        found.setdefault(name, TestVerdict(name, outcome == PASSED, number, failed))
    return found
