"""Workflows of GitHub Actions, read as data."""

import pytest

from grader.checks import Missed
from grader.exercises.testing.limiter.ci_workflow import read_workflow, require_tests
from tests.exercises.testing.limiter.students import CI, IN_ONE_STEP

PATH = "test.yml"
RESULT = "      - run: source /opt/ros/jazzy/setup.bash && colcon test-result --verbose\n"
BY_ITS_STATUS = CI.replace(RESULT, "").replace("colcon test\n", "colcon test --return-code-on-test-failure\n")
BY_ROS_TOOLING = """\
on: [push]
jobs:
  test:
    runs-on: ubuntu-latest
    container: rostooling/setup-ros-docker:ubuntu-noble-ros-jazzy-ros-base-latest
    steps:
      - uses: ros-tooling/action-ros-ci@v0.4
        with:
          target-ros2-distro: jazzy
          package-name: limiter
"""
BY_INDUSTRIAL_CI = """\
on: [push]
jobs:
  industrial_ci:
    runs-on: ubuntu-latest
    env: {ROS_DISTRO: jazzy}
    steps:
      - uses: actions/checkout@v4
      - uses: ros-industrial/industrial_ci@master
"""


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
        BY_ITS_STATUS,
        BY_ROS_TOOLING,
        BY_ROS_TOOLING.replace("    container: rostooling/setup-ros-docker:ubuntu-noble-ros-jazzy-ros-base-latest\n", "").replace(
            "steps:\n", "steps:\n      - uses: ros-tooling/setup-ros@v0.7\n"
        ),
        BY_INDUSTRIAL_CI,
        CI.replace("source /opt/ros/jazzy/setup.bash && source install", "source install"),
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
STATUS = "colcon test exits with 0 even if a test fails, unless it has --return-code-on-test-failure; colcon test-result doesn't."
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
         ("source /opt/ros/jazzy/setup.bash before colcon build, in the same step", "no such line", SOURCED, 0.0)),
        ("source /opt/ros/jazzy/setup.bash && source install/setup.bash && colcon test\n", "colcon test\n",
         ("source /opt/ros/jazzy/setup.bash before colcon test, in the same step", "no such line", SOURCED, 0.5)),
        (" && colcon build", "", ("`colcon build` in a step", "no such command", "Run it in a step.", 0.0)),
        (" && colcon test\n", "\n", ("`colcon test` in a step", "no such command", "Run it in a step.", 0.0)),
        (RESULT, "", ("`colcon test-result` in a step", "no such command", STATUS, 0.5)),
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


@pytest.mark.parametrize(
    ("old", "new", "wanted"),
    [
        ("jazzy\n          package", "kilted\n          package",
         ("target-ros2-distro: jazzy for ros-tooling/action-ros-ci", "kilted", "Give it in the step, below `with:`.", 0.5)),
        ("ubuntu-noble-ros-jazzy-ros-base-latest", "ubuntu-noble-latest",
         ("a container with ROS 2 Jazzy", "rostooling/setup-ros-docker:ubuntu-noble-latest", "`container: ros:jazzy` runs the steps where ROS is installed.", 0.0)),
        ("    runs-on", "    continue-on-error: true\n    runs-on",
         ("a workflow that fails if a test fails", "a failure that is ignored", HIDES, 0.5)),
    ],
)  # fmt: skip
def test_an_action_that_builds_and_tests_needs_its_distribution(old, new, wanted):
    assert old in BY_ROS_TOOLING
    assert missed(BY_ROS_TOOLING.replace(old, new)) == wanted


def test_a_status_that_is_ignored_hides_a_failure():
    ignored = BY_ITS_STATUS.replace("failure\n", "failure || true\n")
    assert missed(ignored) == ("a workflow that fails if a test fails", "a failure that is ignored", HIDES, 0.5)
