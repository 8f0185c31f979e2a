"""What was typed in terminals: the lines that failed, and what is said about them."""

import pytest

from grader.checks import Missed
from grader.checks.typed import HINTS, failed_lines, first_failure
from sim.evidence import Recording

PRINTED = {
    "`|` needs a shell, but there is none here: leave it out": "needs a shell",
    "bash: No closing quotation: a quote that is opened has to be closed": "has to be closed",
    "rso2: command not found. Did you mean ros2?": "command not found",
    "Package 'demo' not found: it is not built": "it is not built|colcon build makes it",
    "bash: install/setup.bash: No such file or directory: colcon build makes it": (
        "it is not built|colcon build makes it"
    ),
    "Package 'demo' not found: source ws/install/setup.bash was not typed in this terminal": (
        "not typed in this terminal"
    ),
    "Package 'demo' not found: source ws/install/setup.bash again, because it was built later": (
        "it was built later"
    ),
    "The directory already exists: ws/src/demo": "directory already exists",
    "There are no nodes on ROS domain 0, but on 42: export ROS_DOMAIN_ID=42": "ROS domain",
    "Summary: 0 packages finished: there is no package 'domo'": "Summary: 0 packages",
    "colcon test is not executed here: colcon build is": "colcon build is",
    'A value with spaces needs quotes around it: "{linear: {x: 0.5}}".': "needs quotes",
    "ros2: error: argument COMMAND: there is no 'rum', only action": "error: ",
    "bash: setup.bash: No such file or directory: cd to the right folder first": "No such file",
    "line 5 is still running in terminal 1": "running in terminal",
    "python -m sim is running in terminal 1: open another one": "running in terminal",
    "Package 'dem' not found: did you mean demo?": "No executable found|Package .* not found",
    "Unable to find node '/drivr'": "Node not found|Unable to find node",
    "Setting parameter failed: Wrong parameter type, expected": "arameter type",
    "Setting parameter failed: Invalid access to undeclared parameter(s): []": "arameter",
    "The passed service type is invalid": "type is invalid",
    "Wait for service timed out waiting for /x": "service",
    "Failed to populate field: 'x'": "populate field|needs a space|YAML",
    "sleep: invalid time interval 'six'": "time interval",
}


def recording(*lines):
    """A run whose terminals show these lines."""
    return Recording(prints=[(0.0, f"{line}\n") for line in lines])


def missed(run):
    with pytest.raises(Missed) as raised, first_failure(run):
        raise Missed("commands", "none", "Start it.")
    return raised.value


@pytest.mark.parametrize("printed", PRINTED)
def test_a_line_that_failed_is_shown_with_what_to_do(printed):
    miss = missed(recording("terminal 1, line 4 $ ros2 x", printed, "", "[line 4 failed]"))
    assert (miss.expected, miss.saw) == ("commands", f"none; line 4 failed: “{printed}”")
    assert miss.hint == HINTS[PRINTED[printed]]


def test_every_hint_is_given():
    assert set(PRINTED.values()) == set(HINTS)


def test_a_line_of_an_unknown_kind_keeps_the_hint():
    miss = missed(recording("terminal 1, line 4 $ ros2 x", "It is strange", "[line 4 failed]"))
    assert (miss.saw, miss.hint) == ("none; line 4 failed: “It is strange”", "Start it.")


def test_without_a_line_that_failed_a_miss_stays_what_it_is():
    miss = missed(recording("terminal 1, line 4 $ ros2 x", "well"))
    assert (miss.saw, miss.hint) == ("none", "Start it.")


def test_a_line_whose_command_worked_later_comes_last():
    run = recording(
        *("terminal 1, line 1 $ ros2 run demo diver", "no", "[line 1 failed]"),
        *(
            "terminal 1, line 2 $ ros2 run demo driver",
            "terminal 2, line 3 $ sleep six",
            "so",
            "[line 3 failed]",
        ),
    )
    assert [line.number for line in failed_lines(run)] == [3, 1]
    assert failed_lines(recording("[line 9 failed]")) == [(9, "")]
