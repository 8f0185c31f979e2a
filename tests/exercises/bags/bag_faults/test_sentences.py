"""Hints about amounts and moments of the faults, for numbers that no student's node here reports."""

import math
from dataclasses import replace

import pytest

from grader.exercises.bags.bag_faults import _amount_hint, _false_alarm, _moment_hint
from grader.exercises.bags.bag_faults.faulty_bags import BUSY, FAULTS, NONE, draw_case, rows_of


@pytest.mark.parametrize(
    ("kind", "off", "hint"),
    [
        ("two_odometries", 0.3, "It is the distance between what the two report at the same moment, in meters."),
        ("lidar_yaw", 0.05, "It is the angle by which the lidar is turned further than /tf_static says. Try finer steps."),
    ],
)
def test_an_amount_that_is_off_has_a_hint(kind, off, hint):
    case = draw_case(kind, 1)
    assert _amount_hint(case, case.amount + off) == hint


def test_the_whole_angle_of_the_lidar_is_no_error():
    case = replace(draw_case("lidar_yaw", 1), mount=(0.0, 0.0, math.pi / 2))
    hint = "That is the whole angle of the lidar: how far is it from what /tf_static says?"
    assert _amount_hint(case, case.amount + math.pi / 2) == hint


def test_a_moment_and_a_false_alarm_have_hints():
    late = "Take the stamp of a scan that can't be transformed yet."
    assert _moment_hint(draw_case("missing_transform", 1)) == late
    kept = "/tf_static has several messages: keep the transforms of all of them."
    assert _false_alarm("missing_transform") == kept


@pytest.mark.parametrize("kind", [*FAULTS, NONE, BUSY])
def test_equal_seeds_give_equal_bags_and_other_seeds_other_ones(kind):
    case, again, other = draw_case(kind, 1), draw_case(kind, 1), draw_case(kind, 2)
    assert case == again != other
    assert rows_of(case) == rows_of(again)
    topics = {row.topic for row in rows_of(case)}
    assert topics == {"/cmd_vel", "/imu/data", "/odom", "/scan", "/tf", "/tf_static"}
