"""A package with tests: they pass right nodes, catch wrong ones, and run with each push."""

import re
from functools import partial

from grader.checks import Missed, hinting, otherwise, publishes
from grader.checks.candidate_verdicts import TestVerdict, candidate_verdicts, own_verdict
from grader.checks.packages import package_of
from grader.companions.test_runner import VERDICTS, run_tests
from grader.exercise import Exercise, Scenario
from grader.exercises.testing.limiter.ci_workflow import read_workflow, require_tests
from grader.exercises.testing.limiter.limiter_candidates import RIGHT, WRONG, candidates, companions
from grader.workspace.package import PackageRun

TESTS, WORKFLOWS = "limiter/test/", "limiter/.github/workflows/"
ALL = len(RIGHT) + len(WRONG)
_SLEEP = re.compile(r"^(?:[^#\"'\n]*\s)?((?:\w+\.)*sleep\(.*)$", re.M)
ENOUGH = 9  # of the wrong ones: no line of the contract can be left out
TOO_STRICT = ("Require no more than the contract does: the zero after silence may be 0.1 s late, and /hold "
              "may respond with any message.")


limiter = Exercise("limiter", "A package with tests", package="limiter", scenarios=[
    Scenario(seconds=600, seed=1, prepare=partial(run_tests, "limiter", "limiter/node.py"),
             companions=companions, until=lambda run: len(run.messages(VERDICTS)) > ALL),
], may_end=True)


@limiter.check(2, hints={
    "pytest finds files test_*.py in test/, and functions test_... in them.":
        lambda run, own: own is not None and not own.tests,
    "A test failed on your own limiter. Run colcon test in a terminal to see why.": otherwise,
})
def tests_pass_on_your_node(run: PackageRun) -> TestVerdict:
    """The package has tests that never sleep, and they pass on its own limiter."""
    with hinting("Your tests take too long: wait for what should arrive, and no longer than you have to."):
        publishes(run, VERDICTS, "std_msgs/msg/String")
    own = own_verdict(run, "limiter/node.py")
    for path, source in package_of(run).sources.items():
        found = _SLEEP.search(source.decode("utf-8", "replace")) if path.startswith(TESTS) else None
        if found:
            hint = "While a test sleeps, no node runs: wait for the answer with bench.wait(...)."
            raise Missed("no call of sleep", f"`{found[1]}` in ws/src/{path}", hint, credit=0.5, measured=own)
    return own


@limiter.check(3, after=tests_pass_on_your_node)
def passes_what_is_right(run: PackageRun, own: TestVerdict) -> None:
    """The tests pass on all three correct limiters, and fail on at least one of the wrong ones."""
    for right, verdict in _judged(run):
        if right and not verdict.passed:
            raise Missed(f"candidate {verdict.name} passing: it is right", verdict.failed, TOO_STRICT)
    if all(verdict.passed for _, verdict in _judged(run)):
        hint = ("A test that asserts nothing passes everything. What must be published on /speed, and how "
                "often?")
        raise Missed("at least one of the ten wrong candidates to fail", "all passed", hint)


@limiter.check(9, after=(tests_pass_on_your_node, passes_what_is_right))
def catches_what_is_wrong(run: PackageRun, own: TestVerdict, _: None) -> None:
    """The tests fail on at least nine of the ten wrong limiters."""
    caught = sum(not verdict.passed for right, verdict in _judged(run) if not right)
    if caught < ENOUGH:
        hint = "Write a test for each line of the contract: both signs, inf, nan, another limit, silence."
        expected = f"{ENOUGH} or more of {len(WRONG)} caught"
        raise Missed(expected, f"{caught}", hint, credit=caught / len(WRONG))


@limiter.check(4)
def runs_with_each_push(run: PackageRun) -> None:
    """A workflow in .github/workflows builds the package and runs its tests, and fails if one fails."""
    sources = package_of(run).sources
    found = [path for path in sources if path.startswith(WORKFLOWS) and path.endswith((".yml", ".yaml"))]
    if not found:
        raise Missed(f"ws/src/{WORKFLOWS}test.yml", "no such file",
                     "GitHub looks for workflows there: put the file in that folder.")
    require_tests(read_workflow(found[0], sources[found[0]]))


def _judged(run: PackageRun) -> list[tuple[bool, TestVerdict]]:
    """Return whether a candidate is right, and the verdict on it."""
    hint = "A wrong limiter may publish nothing: give each loop that waits for a message a timeout."
    return candidate_verdicts(run, candidates(run.seed), hint)
