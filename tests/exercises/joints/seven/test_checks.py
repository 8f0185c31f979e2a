"""The last check of `seven` on a recording made by hand: an error is no end."""

import pytest
from std_msgs.msg import Float64

from grader.checks import Missed
from grader.exercises.joints.seven import ends_by_itself, seven
from sim.evidence import CallbackError
from tests.sim.recordings import published


def test_a_program_that_ends_by_an_error_does_not_end_by_itself():
    values = map(float, seven.drawn.positions.split(", "))
    positions = [(2.0 * number, Float64(data=value)) for number, value in enumerate(values, start=1)]
    run = published("/joint_commands", positions, seconds=20.0)
    run.errors.append(CallbackError(16.0, "/joint_publisher", "Seven.send", "IndexError", "out of range", ""))
    with pytest.raises(Missed) as missed:
        ends_by_itself(run)
    assert (missed.value.expected, missed.value.saw) == ("an end without an error", "IndexError: out of range")
