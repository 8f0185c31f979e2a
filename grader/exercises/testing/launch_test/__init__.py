"""A test of a launch file: it passes right launch files, and catches wrong ones."""

from functools import partial

from grader.checks import Missed, hinting, otherwise, publishes
from grader.checks.candidate_verdicts import TestVerdict, candidate_verdicts, own_verdict
from grader.companions.test_runner import VERDICTS, run_tests
from grader.exercise import Exercise, Scenario
from grader.exercises.testing.launch_test.launch_candidates import RIGHT, WRONG, candidates, companions
from grader.workspace.package import PackageRun

FILE = "launch/guard.launch.py"
ALL = len(RIGHT) + len(WRONG)
HANGS = "A wrong launch file may start nothing that publishes: give each loop that waits a timeout."

launch_test = Exercise("launch_test", "A test of a launch file", package="speed_guard", scenarios=[
    Scenario(seconds=600, seed=1, prepare=partial(run_tests, "speed_guard", FILE, True),  # type: ignore[arg-type]  # the workspace comes first
             companions=companions, until=lambda run: len(run.messages(VERDICTS)) > ALL),
], may_end=True)


@launch_test.check(1, hints={
    "pytest finds files test_*.py in test/, and functions test_... in them.":
        lambda run, own: own is not None and not own.tests,
    "What a test starts has to end with it: let a launch_pytest.fixture start it.":
        lambda run, own: own is not None and own.failed.startswith("left running"),
    "A test failed on the launch file of the task. Run colcon test in a terminal to see why.": otherwise,
})
def tests_pass_on_your_launch_file(run: PackageRun) -> TestVerdict:
    """The package has tests, and they pass on its own launch file."""
    with hinting("Your tests take too long: wait for what should arrive, and no longer than you have to."):
        publishes(run, VERDICTS, "std_msgs/msg/String")
    return own_verdict(run, f"speed_guard/{FILE}")


@launch_test.check(1, after=tests_pass_on_your_launch_file)
def passes_right_launch_files(run: PackageRun, own: TestVerdict) -> None:
    """The tests pass on all three correct launch files, and fail on at least one of the wrong ones."""
    judged = candidate_verdicts(run, candidates(run.seed), HANGS)
    for right, verdict in judged:
        if right and not verdict.passed:
            hint = "Test what arrives on which topic, not how the launch file is written."
            raise Missed(f"candidate {verdict.name} passing: it is right", verdict.failed, hint)
    if all(verdict.passed for _, verdict in judged):
        hint = "Publish on /front/wanted, and assert what has to arrive on /front/driven."
        raise Missed("at least one of the nine wrong candidates to fail", "all passed", hint)


@launch_test.check(4, after=(tests_pass_on_your_launch_file, passes_right_launch_files))
def catches_wrong_launch_files(run: PackageRun, own: TestVerdict, _: None) -> None:
    """The tests fail on all nine wrong launch files."""
    judged = candidate_verdicts(run, candidates(run.seed), HANGS)
    caught = sum(not verdict.passed for right, verdict in judged if not right)
    if caught < len(WRONG):
        hint = ("The namespace, a limit or a remapping can be missing, or two limiters can run. Request "
                "more than the limit, forward and backward, and compare all that arrives.")
        expected = f"{len(WRONG)} of {len(WRONG)} caught"
        raise Missed(expected, f"{caught}", hint, credit=caught / len(WRONG))
