"""Measures of a goal of NavigateToPose, in a small hall with a wall between the start and the goal."""

import math

import numpy as np
import pytest
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, Pose, PoseStamped
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import MapMetaData, OccupancyGrid

from grader import Missed
from grader.exercises.navigating.navigate.navigation import (
    ACTION,
    TYPE,
    end_of,
    feedback_faults,
    goals_from_course,
    to_go,
)
from grader.geometry.ground import ground, shortest
from sim import World
from sim.evidence import Goal, Message
from sim.evidence import Pose as TruePose
from sim.ros.messages.codec import encode, type_name
from sim.world import Contact
from tests.sim.recordings import recording

WALL = ((2.0, 0.0), (2.0, 1.5))
HALL = World("hall", "", (0, 0, 4, 2), (0.5, 0.5, 0.0), goal=(3.5, 0.5), walls=(WALL,))
WAY = shortest(HALL)
THERE, LINE = TruePose(1.0, 0.5, 0.5, 0.0), 3.0  # where the robot is all the time, and how far as the crow flies


def goal(*, from_course=True, ended=None, feedback=()):
    events = [(0.0, "accepted"), *([(ended, "succeeded")] if ended is not None else [])]
    raw = encode(NavigateToPose.Goal())
    rows = [
        Message(stamp, f"{ACTION}/_action/feedback", f"{TYPE}_Feedback", "/navigator", encode(message))
        for stamp, message in feedback
    ]
    return Goal(ACTION, TYPE, "/client", "00" * 16, raw, 0.0, "/navigator", events, rows, requested_by_course=from_course)


def driven(*goals, cells=None, contacts=()):
    """A run with a robot that stands at the start of the hall, and a map on /map: by default the true one."""
    cells = ground(HALL).occupied * 100 if cells is None else cells
    info = MapMetaData(height=cells.shape[0], width=cells.shape[1])
    grid = OccupancyGrid(info=info, data=cells.astype(np.int8).ravel().tolist())
    maps = [Message(0.5, "/map", type_name(OccupancyGrid), "/map_server", encode(grid), True)]
    path = [THERE._replace(stamp=n / 10) for n in range(101)]
    return recording(world=HALL, path=path, goals=list(goals), published=maps, contacts=list(contacts))


def feedback(x=0.5, y=0.5, distance=WAY, seconds=10.0):
    place = PoseStamped(pose=Pose(position=Point(x=x, y=y)))
    nanoseconds = round(seconds * 1e9)
    left = Duration(sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)
    return NavigateToPose.Feedback(current_pose=place, distance_remaining=distance, estimated_time_remaining=left)


def faults(*rows, **more):
    one = goal(feedback=rows)
    return feedback_faults(driven(one, **more), one)


def test_the_goals_are_those_of_the_course():
    own, other = goal(), goal(from_course=False)
    assert goals_from_course(driven(other, own)) == [own]


def test_without_a_goal_the_client_found_no_server():
    for run in (recording(), driven(goal(from_course=False))):
        with pytest.raises(Missed) as caught:
            goals_from_course(run)
        assert caught.value.expected == "a goal that a server receives"
        assert caught.value.saw == "no server was there when the client looked for one"


def test_a_goal_ends_at_its_end_or_with_the_run():
    assert end_of(driven(), goal(ended=3.0)) == 3.0
    assert end_of(driven(), goal()) == 10.0


def test_the_distance_to_go_is_that_round_the_wall_and_no_more_than_twice_the_whole_way():
    assert to_go(HALL, THERE) == pytest.approx(WAY, abs=0.1)
    assert WAY > LINE + 0.5
    behind = TruePose(0.0, 2.5, 0.5, 0.0)
    assert to_go(HALL, behind) == pytest.approx(1.0, abs=0.06)
    in_the_wall = TruePose(0.0, 2.0, 0.5, 0.0)
    assert to_go(HALL, in_the_wall) == 2 * WAY


def test_feedback_that_is_right_has_no_faults():
    assert faults((1.0, feedback()), (2.0, feedback())) == []


@pytest.mark.parametrize(("x", "wrong"), [(0.69, False), (0.71, True), (0.29, True), (math.nan, True)])
def test_a_pose_may_be_two_tenths_of_a_meter_off(x, wrong):
    hint = "current_pose is where the robot is in the map, not in its odometry: self.pose."
    expected = ("current_pose at (0.50, 0.50) m, at 2 s", f"({x:.2f}, 0.50) m", hint)
    assert faults((1.0, feedback()), (2.0, feedback(x=x))) == ([expected] if wrong else [])


def test_the_first_wrong_pose_is_shown():
    ((expected, saw, _),) = faults((1.0, feedback()), (2.0, feedback(y=1.0)), (3.0, feedback(x=9.0)))
    assert (expected, saw) == ("current_pose at (0.50, 0.50) m, at 2 s", "(0.50, 1.00) m")


LEAST, MOST = max(LINE, to_go(HALL, THERE) / 1.6) - 0.5, 1.5 * to_go(HALL, THERE) + 0.5


@pytest.mark.parametrize(
    ("distance", "wrong"),
    [(LEAST + 0.01, False), (LEAST - 0.01, True), (MOST - 0.01, False), (MOST + 0.01, True), (math.nan, True)],
)
def test_a_distance_lies_between_the_straight_line_and_half_as_much_again_as_the_way(distance, wrong):
    found = faults((1.0, feedback(distance=distance)))
    hint = "distance_remaining is the length of the path from the robot to its end, in meters."
    expected = f"distance_remaining from {LEAST:.2f} to {MOST:.2f} m at 1 s"
    assert found == ([(expected, f"{distance:.2f} m", hint)] if wrong else [])


FAR = World("hall", "", (0, 0, 4, 9), (0.5, 0.5, 0.0), goal=(3.5, 0.5), walls=(((2.0, 0.0), (2.0, 8.0)),))


@pytest.mark.parametrize(
    ("share", "expected"),
    [(0, []), (100, [f"distance_remaining from {to_go(FAR, THERE) / 1.6 - 0.5:.2f}"])],
)
def test_where_the_map_lacks_something_the_plan_may_lead_through_it(share, expected):
    one = goal(feedback=[(1.0, feedback(distance=3.0))])
    run = driven(one, cells=ground(FAR).occupied * share)
    run.world = FAR
    assert [fault[0].split(" to ")[0] for fault in feedback_faults(run, one)] == expected


def test_near_the_goal_no_distance_is_too_small():
    one = goal(feedback=[(1.0, feedback(x=3.4, distance=0.0))])
    run = driven(one)
    run.path = [pose._replace(x=3.4) for pose in run.path]
    assert feedback_faults(run, one) == []


def test_after_a_touch_feedback_is_not_judged_as_odometry_is_wrong_then():
    touch = Contact(2.0, 3.0, 0.0, 0.0, "front", "wall")
    assert faults((1.0, feedback()), (2.0, feedback(x=9.0)), contacts=[touch]) == []
    assert len(faults((1.9, feedback(x=9.0)), contacts=[touch])) == 1


@pytest.mark.parametrize(("seconds", "wrong"), [((3.0, 2.0, 0.0, 0.0), False), ((3.0, 0.0, 0.0, 0.0), True), ((0.0,), False)])
def test_an_estimate_is_above_0_in_the_first_half_of_the_way(seconds, wrong):
    found = faults(*((float(n), feedback(seconds=left)) for n, left in enumerate(seconds, 1)))
    hint = "It is the distance divided by the speed, as a message: Duration(seconds=distance / speed).to_msg()."
    expected = ("an estimated_time_remaining above 0 on the way", "0 s or less", hint)
    assert found == ([expected] if wrong else [])
