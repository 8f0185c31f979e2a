"""Speeds and distances along a path, against figures worked out by hand."""

import math

import pytest

from grader.checks import Missed
from grader.responses import Speed, Window, closest, require_standing, speeds, top_speed
from sim.evidence import Pose, Recording

PATH = [
    Pose(0.0, 0.0, 0.0, 0.0),
    Pose(1.0, 0.3, 0.4, 0.0),
    Pose(2.0, 0.3, 0.4, 0.5),
    Pose(2.5, 0.3, 0.4, 0.5),
]


def test_a_speed_is_the_mean_between_two_poses():
    assert speeds(PATH) == [Speed(1.0, 0.5, 0.0), Speed(2.0, 0.0, 0.5), Speed(2.5, 0.0, 0.0)]


def test_a_turn_through_pi_is_a_short_one():
    turned = speeds([Pose(0.0, 0.0, 0.0, 3.1), Pose(1.0, 0.0, 0.0, -3.1)])
    assert turned[0].angular == pytest.approx(math.tau - 6.2)


def test_the_top_speed_is_the_highest_and_zero_without_a_path():
    assert top_speed(PATH) == Speed(1.0, 0.5, 0.0)
    assert top_speed([]) == Speed(0.0, 0.0, 0.0)


def test_the_closest_pose_has_its_moment():
    assert closest(PATH, (0.3, 0.0)) == (pytest.approx(0.3), 0.0)
    assert closest([], (0.0, 0.0)) == (math.inf, 0.0)


def test_standing_is_required_within_the_window_only():
    require_standing(Recording(path=PATH), Window(2.0, 2.5), "after the stop", "Stop.")
    with pytest.raises(Missed) as missed:
        require_standing(Recording(path=PATH), Window(0.0, 1.0), "after the stop", "Publish zeros.")
    assert (missed.value.expected, missed.value.saw, missed.value.hint, missed.value.unsafe) == (
        "the robot standing still, after the stop",
        "0.50 m/s and 0.00 rad/s at 1 s",
        "Publish zeros.",
        True,
    )
