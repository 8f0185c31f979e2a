"""Velocity commands: their speeds, and their text."""

import pytest
from geometry_msgs.msg import Twist, Vector3

from grader.checks.twists import SAME, speeds, speeds_text
from grader.responses import same
from tests.sim.recordings import published


def test_the_speeds_of_a_command_are_those_that_a_robot_on_wheels_has():
    command = Twist(linear=Vector3(x=0.3, y=1.0, z=2.0), angular=Vector3(x=3.0, y=4.0, z=-0.5))
    (row,) = published("/cmd_vel", [(1.0, command)]).published
    assert speeds(row) == (0.3, -0.5)


def test_speeds_are_shown_with_three_digits():
    assert speeds_text((0.30001, -1.23456)) == "linear.x 0.3, angular.z -1.23"


@pytest.mark.parametrize(
    ("other", "is_same"), [((0.3009, -0.5), True), ((0.3011, -0.5), False), ((0.3, -0.4989), False)]
)
def test_speeds_are_the_same_within_a_thousandth(other, is_same):
    assert same((0.3, -0.5), other, SAME) == is_same
