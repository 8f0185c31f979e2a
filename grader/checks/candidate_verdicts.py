"""What a package's tests did on its own file, and on right and wrong ones in place of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from grader.checks.check import Missed
from grader.companions.test_runner import CANDIDATES, OWN, PASSED, VERDICTS
from sim.evidence import Recording

LEAVE_VERDICTS = f"What runs your tests publishes on {VERDICTS}: your tests leave that topic alone."
LOOKS_AT_THE_FILE = "A test runs the file that it tests, and sends it something: to read it is no test."
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
    own = _verdicts(run).get(OWN)
    if own is None:
        raise Missed(f"the outcome of the tests on {file}", f"none on {VERDICTS}", LEAVE_VERDICTS)
    if not own.passed or not own.tests:
        saw = "no test" if own.failed in ("", NOTHING_FOUND) else own.failed
        raise Missed(f"tests that pass on {file}", saw, about=(own,))
    return own


def candidate_verdicts(
    run: Recording, truth: Sequence[tuple[bool, str]], hint: str
) -> list[tuple[bool, TestVerdict]]:
    """Return whether a candidate is right, and its verdict. Raises Missed, with the hint, if it has none."""
    found = _verdicts(run)
    for number in range(1, len(truth) + 1):
        if str(number) not in found:
            raise Missed(f"verdicts on {len(truth)} candidates", f"none on candidate {number}", hint)
        _requires_traffic(run, str(number))
    return [(right, found[str(number)]) for number, (right, _) in enumerate(truth, 1)]


def _requires_traffic(run: Recording, name: str) -> None:
    """Raise Missed if the tests published nothing from when a candidate was sent to the verdict on it."""
    sent = [row.stamp for row in run.messages(CANDIDATES) if row.message.data.partition("\n")[0] == name]
    ended = [row.stamp for row in run.messages(VERDICTS) if row.message.data.split(" ")[0] == name]
    meanwhile = run.during(min(sent, default=0.0), min(ended)).messages()
    if not any(row.topic != VERDICTS and not row.from_course for row in meanwhile):
        raise Missed(f"messages while candidate {name} is tested", "none", LOOKS_AT_THE_FILE)


def _verdicts(run: Recording) -> dict[str, TestVerdict]:
    """The first verdict on each candidate, by its name."""
    found: dict[str, TestVerdict] = {}
    for row in run.messages(VERDICTS):
        name, outcome, tests, failed = [*row.message.data.split(" ", 3), "", "", ""][:4]
        number = int(tests) if tests.isdigit() else 0
        found.setdefault(name, TestVerdict(name, outcome == PASSED, number, failed))
    return found
