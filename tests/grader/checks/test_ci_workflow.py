"""Workflows of GitHub Actions, read as data."""

import pytest

from grader.checks import Missed
from grader.checks.ci_workflow import read_workflow, require_tests
from tests.students.packages.limiter import CI, IN_ONE_STEP

PATH = "test.yml"


def missed(text):
    """What a workflow misses: expected, saw, hint, credit."""
    with pytest.raises(Missed) as raised:
        require_tests(read_workflow(PATH, text.encode()))
    return raised.value.expected, raised.value.saw, raised.value.hint, raised.value.credit


@pytest.mark.parametrize(
    "text",
    [
        CI,
        f"\ufeff{CI}",
        IN_ONE_STEP,
        CI.replace("[push, pull_request]", "push"),
        CI.replace("container: ros:jazzy", "container: {image: 'osrf/ros:jazzy-desktop'}"),
        CI.replace("    container: ros:jazzy\n", "").replace(
            "checkout@v4\n", "checkout@v4\n      - uses: ros-tooling/setup-ros@v0.7\n"
        ),
        CI + "  other:\n    runs-on: ubuntu-latest\n    steps: [{run: echo}]\n  strange: 7\n",
    ],
)
def test_a_workflow_that_tests_is_right(text):
    require_tests(read_workflow(PATH, text.encode()))


def test_what_is_no_workflow_is_missed_with_its_line():
    spaces = "Indent with spaces, two for each level, never with tabs."
    assert missed("a: 1\n\tb: 2") == (
        "a workflow in test.yml",
        "text that isn't valid YAML: line 2",
        spaces,
        0.0,
    )
    assert missed("text") == (
        "a workflow in test.yml",
        "no keys",
        "It needs the keys name, on and jobs.",
        0.0,
    )
    long = "More than 20000 bytes are not read: make it shorter."
    assert missed("#" * 20_001) == ("a workflow in test.yml", "20001 bytes", long, 0.0)
    with pytest.raises(Missed) as raised:
        read_workflow(PATH, b"\xff\xff")
    assert raised.value.saw == "text that isn't valid YAML"


SOURCED = "Each step runs in a new shell: source /opt/ros/jazzy/setup.bash, then call colcon."
RESULT = "colcon test exits with 0 even if a test fails; colcon test-result doesn't."
HIDES = "A workflow fails if one of its commands fails: remove whatever hides that."


@pytest.mark.parametrize(
    ("old", "new", "wanted"),
    [
        ("on: [push, pull_request]", "on: schedule",
         ("a workflow that starts on push or pull_request", "schedule", "`on: [push]` starts it on every push.", 0.0)),
        ("jobs:", "job:", ("a job below `jobs:`", "none", "A job needs a name, runs-on, a container and steps.", 0.0)),
        ("      - uses: actions/checkout@v4\n", "",
         ("a step that uses actions/checkout", "none", "Add it: without it, none of your files are there.", 0.0)),
        ("ros:jazzy", "ros:humble",
         ("a container with ROS 2 Jazzy", "ros:humble", "`container: ros:jazzy` runs the steps where ROS is installed.", 0.0)),
        ("source /opt/ros/jazzy/setup.bash && ", "",
         ("source /opt/ros/jazzy/setup.bash before colcon", "no such line", SOURCED, 0.0)),
        (" && colcon build", "", ("`colcon build` in a step", "no such command", "Run it in a step.", 0.0)),
        (" && colcon test\n", "\n", ("`colcon test` in a step", "no such command", "Run it in a step.", 0.0)),
        ("colcon test-result", "# colcon test-result", ("`colcon test-result` in a step", "no such command", RESULT, 0.5)),
        ("test-result --verbose", "test-result || true",
         ("a workflow that fails if a test fails", "a failure that is ignored", HIDES, 0.5)),
        ("    runs-on", "    continue-on-error: true\n    runs-on",
         ("a workflow that fails if a test fails", "a failure that is ignored", HIDES, 0.5)),
    ],
)  # fmt: skip
def test_each_line_that_is_missing_is_named(old, new, wanted):
    assert old in CI
    assert missed(CI.replace(old, new)) == wanted


def test_the_order_of_the_commands_counts():
    swapped = (
        CI.replace("colcon build", "colcon X").replace("colcon test\n", "colcon build\n").replace("X", "test")
    )
    assert missed(swapped)[:2] == (
        "colcon build, colcon test, colcon test-result, in this order",
        "colcon test, colcon build, colcon test-result",
    )
