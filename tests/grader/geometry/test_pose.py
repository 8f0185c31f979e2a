"""A planar pose: from messages, with points of its frame, and compared with another."""

import math

import pytest
from geometry_msgs.msg import Pose, Transform

from grader.geometry import Pose2D


def test_it_is_read_from_a_pose_and_from_a_transform():
    pose = Pose()
    pose.position.x, pose.position.y, pose.orientation.z, pose.orientation.w = 1.0, 2.0, 1.0, 0.0
    transform = Transform()
    transform.translation.x, transform.translation.y = 1.0, 2.0
    transform.rotation.z, transform.rotation.w = 1.0, 0.0
    for message in (pose, transform):
        found = Pose2D.from_message(message)
        assert (found.x, found.y, abs(found.yaw)) == (1.0, 2.0, pytest.approx(math.pi))


def test_a_point_ahead_and_one_to_the_left():
    pose = Pose2D(1.0, 2.0, math.pi / 2)
    assert pose.point((1.0, 0.0)) == pytest.approx((1.0, 3.0))
    assert pose.point((0.0, 1.0)) == pytest.approx((0.0, 2.0))


def test_near_is_by_distance_and_by_the_shorter_turn():
    pose = Pose2D(0.0, 0.0, 3.1)
    assert pose.is_near(Pose2D(0.0, 0.1, -3.1), 0.1, 0.1)
    assert not pose.is_near(Pose2D(0.0, 0.2, 3.1), 0.1, 0.1)
    assert not pose.is_near(Pose2D(0.0, 0.0, 2.9), 0.1, 0.1)
    assert not pose.is_near(Pose2D(0.0, 0.0, math.nan), 0.1, 0.1)


def test_its_text_has_units():
    assert str(Pose2D(1.0, -0.5, 0.25)) == "x 1.00 m, y -0.50 m, yaw 0.25 rad"


def test_a_pose_between_two_is_turned_the_shorter_way():
    begin, end = Pose2D(1.0, 2.0, 3.0), Pose2D(3.0, 1.0, -3.0)
    assert begin.towards(end, 0.0) == begin
    assert begin.towards(end, 0.5) == pytest.approx((2.0, 1.5, math.pi))
    assert begin.towards(end, 1.0) == pytest.approx((3.0, 1.0, math.tau - 3.0))
