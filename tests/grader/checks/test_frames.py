"""Measures over transforms, on recordings written by hand."""

import math

import pytest
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from grader import Missed
from grader.checks.frames import FULL_TURN, Broadcast, between, broadcasts
from grader.geometry import Pose2D
from tests.sim.recordings import exchange
from tests.sim.warehouse import stamp


def transform(parent, child, *, x=0.0, yaw=0.0, length=1.0, at=0.0):
    rotation = Quaternion(z=length * math.sin(yaw / 2), w=length * math.cos(yaw / 2))
    moved = Transform(translation=Vector3(x=x, y=0.5), rotation=rotation)
    return TransformStamped(header=Header(frame_id=parent, stamp=stamp(at)), child_frame_id=child, transform=moved)


def test_a_broadcast_is_where_a_frame_is_when_that_was_measured_and_when_it_was_sent():
    sent = Broadcast(1.25, transform("odom", "base_link", x=2.0, yaw=0.5, at=1.0))
    assert (sent.frames, sent.stamp, sent.measured) == ("odom → base_link", 1.25, 1.0)
    assert sent.pose == pytest.approx(Pose2D(2.0, 0.5, 0.5))


@pytest.mark.parametrize(
    ("squared", "is_rotation"), [(1.0, True), (1.009, True), (1.011, False), (0.991, True), (0.989, False), (0.0, False)]
)
def test_a_rotation_has_a_quaternion_of_length_1_but_for_a_hundredth_of_its_square(squared, is_rotation):
    assert Broadcast(0.0, transform("a", "b", yaw=0.5, length=math.sqrt(squared))).is_rotation == is_rotation


@pytest.mark.parametrize("axis", ["x", "y", "z", "w"])
def test_every_part_of_a_quaternion_counts(axis):
    message = transform("a", "b")
    message.transform.rotation = Quaternion(**{"w": 0.0, axis: -1.0})
    assert Broadcast(0.0, message).is_rotation


def sent():
    own = [(1.0, TFMessage(transforms=[transform("a", "b"), transform("a", "c")])), (2.0, TFMessage(transforms=[transform("b", "d")]))]
    return exchange(("/tf", own, False), ("/tf", [(3.0, TFMessage(transforms=[transform("map", "b")]))], True))


def test_broadcasts_are_the_students_or_the_courses_of_all_frames_or_of_one():
    def found(**options):
        return [(one.stamp, one.frames) for one in broadcasts(sent(), "/tf", **options)]

    assert found() == [(1.0, "a → b"), (1.0, "a → c"), (2.0, "b → d")]
    assert found(child="b") == [(1.0, "a → b")]
    assert found(from_course=True) == [(3.0, "map → b")]
    assert broadcasts(sent(), "/tf_static") == []


def missed(rows, is_there=lambda one: False):
    with pytest.raises(Missed) as caught:
        between(rows, "odom", "base_link", "/tf", is_there)
    return caught.value


def test_the_transforms_between_two_frames_are_given():
    rows = [Broadcast(1.0, transform("odom", "base_link")), Broadcast(1.0, transform("odom", "laser"))]
    assert between(rows, "odom", "base_link", "/tf", lambda one: False) == rows[:1]


def test_other_frames_are_named_once_and_the_hint_says_which_is_which():
    rows = [Broadcast(1.0, transform("odom", child)) for child in ("base", "laser", "base")]
    miss = missed(rows)
    assert (miss.expected, miss.saw) == ("odom → base_link on /tf", "odom → base, odom → laser")
    assert miss.hint == "header.frame_id is the parent, child_frame_id the child. Every letter counts."
    assert (miss.credit, miss.measured) == (0.0, [])
    assert missed([]).saw == "no transform"


def test_swapped_frames_have_a_hint_of_their_own():
    rows = [Broadcast(1.0, transform("odom", "laser")), Broadcast(1.0, transform("base_link", "odom"))]
    assert missed(rows).hint == (
        "Parent and child are swapped: header.frame_id is the parent, child_frame_id the child."
    )


def test_a_part_is_earned_where_the_last_one_is_right_but_for_its_frames():
    first, last = (Broadcast(float(n), transform("odom", "base", x=float(n))) for n in range(2))
    miss = missed([first, last], lambda one: one.pose.x == 1.0)
    assert (miss.credit, miss.measured) == (0.2, [last])
    assert missed([last, first], lambda one: one.pose.x == 1.0).credit == 0.0


def test_a_quaternion_is_explained():
    assert FULL_TURN == (
        "A quaternion is not an angle: for a rotation by yaw about z, z = sin(yaw / 2) and w = cos(yaw / 2). "
        "quaternion_from_euler(0, 0, yaw) returns all four numbers."
    )
