"""Nothing that a student's program sends passes a check as NaN or infinity, and nothing breaks a check."""

import math

import pytest
from geometry_msgs.msg import Point, Pose, PoseArray

from grader import Exercise
from grader.checks import Missed
from tests.exercises.assignment import first_run, is_long
from tests.exercises.chance import card_of
from tests.exercises.changed_recordings import (
    NO_NUMBERS,
    Field,
    changes,
    fields_of,
    other_recordings,
    score_of,
    strange_numbers,
)
from tests.exercises.test_adversaries import ALL
from tests.sim.recordings import published

EXERCISES = [
    pytest.param(
        assignment,
        name,
        id=f"{assignment.topic()}-{name}",
        marks=[pytest.mark.soak] if is_long(assignment.judge(name)) else [],
    )
    for assignment, name in ALL
]


@pytest.mark.parametrize(("assignment", "name"), EXERCISES)
def test_nan_and_infinity_earn_no_more_than_a_wrong_number(assignment, name):
    exercise, runs = first_run(assignment.judge(name)), card_of(assignment.topic(), name).runs
    for field, scores in strange_numbers(exercise, runs):
        strange, wrong = scores[: len(NO_NUMBERS)], scores[len(NO_NUMBERS) :]
        assert max(strange) <= max(wrong), field
        assert [verdict.alarm for score in scores for verdict in score.broken] == [], field


@pytest.mark.parametrize(("assignment", "name"), EXERCISES)
def test_nothing_that_is_sent_breaks_a_check(assignment, name):
    exercise, [first, *others] = first_run(assignment.judge(name)), card_of(assignment.topic(), name).runs
    for what, recording in other_recordings(first):
        alarms = [verdict.alarm for verdict in score_of(exercise, [recording, *others]).broken]
        assert alarms == [], what


def poses(*places):
    message = PoseArray(poses=[Pose(position=Point(x=x)) for x in places])
    message.header.frame_id = "map"
    return message


def test_a_field_is_changed_in_every_item_of_a_list_and_in_nothing_else():
    recording = published("/poses", [(0.0, poses(1.0, 2.0)), (1.0, poses(3.0))])
    field = Field("topic", "/poses", "poses[].position.x", "double")
    assert field in fields_of(recording)
    for value, other in zip((math.inf, 5.0), changes(recording, field, (math.inf, 5.0), 0.5), strict=True):
        rows = other.messages("/poses")
        assert [[pose.position.x for pose in row.message.poses] for row in rows] == [[1.0, 2.0], [value]]
        assert rows[1].message.header.frame_id == "map"


def test_a_list_can_be_cut():
    recording = published("/poses", [(0.0, poses(1.0, 2.0))])
    poses_as_a_list = Field("topic", "/poses", "poses", "list")
    for left, other in zip((0, -1), changes(recording, poses_as_a_list, (0, -1)), strict=True):
        [row] = other.messages("/poses")
        assert [pose.position.x for pose in row.message.poses] == [1.0, 2.0][:left]


def test_a_check_that_nan_passes_is_found():
    exercise = Exercise("places", "Places")

    @exercise.check(2)
    def is_at_one(run):
        """The first pose is at 1 m."""
        x = run.messages("/poses")[0].message.poses[0].position.x
        if abs(x - 1.0) > 0.1:
            raise Missed("1 m", f"{x:g} m")

    found = dict(strange_numbers(exercise, [published("/poses", [(0.0, poses(1.0))])]))
    assert found["topic /poses poses[].position.x"] == [2.0, 0.0, 0.0, 0.0, 0.0]
