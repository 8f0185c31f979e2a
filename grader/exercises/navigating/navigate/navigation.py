"""Measures of a goal of Nav2's NavigateToPose: how far the robot still has to go, and what feedback says."""

from __future__ import annotations

import math

import numpy as np

from grader.checks.check import Missed
from grader.checks.motion import goal_in, world_in
from grader.geometry.ground import ground, shortest
from grader.geometry.near import is_near
from grader.geometry.occupancy import cells_of
from sim.evidence import Goal, Message, Pose, Recording, Seconds
from sim.nanoseconds import in_seconds
from sim.world import World

ACTION, TYPE = "/navigate_to_pose", "nav2_msgs/action/NavigateToPose"

Fault = tuple[str, str, str]  # expected, saw, hint


def goals_from_course(run: Recording) -> list[Goal]:
    """Return the goals that the course's client sent. Raises Missed without one."""
    goals = [goal for goal in run.goals_of(ACTION) if goal.requested_by_course]
    if not goals:
        raise Missed("a goal that a server receives", "no server was there when the client looked for one")
    return goals


def end_of(run: Recording, goal: Goal) -> Seconds:
    """Return when the goal ended, or the run."""
    return run.path[-1].stamp if goal.ended is None else goal.ended


def to_go(world: World, pose: Pose) -> float:
    """Return how far it is to drive to the world's goal (m); a large number where there is no path."""
    floor = ground(world)
    column, row = floor.cell((pose.x, pose.y))
    return min(float(floor.to_goal()[row, column]), 2 * shortest(world))


def feedback_faults(run: Recording, goal: Goal) -> list[Fault]:
    """Return what is wrong in the feedback: the first wrong pose, the first wrong distance, the estimates."""
    faults = _wrong_pose(run, goal), _wrong_distance(run, goal), _no_estimate(goal)
    return [fault for fault in faults if fault]


def _wrong_pose(run: Recording, goal: Goal) -> Fault | None:
    for row in _before_a_touch(run, goal):
        place, true = row.message.current_pose.pose.position, run.pose_at(row.stamp)
        if not is_near((place.x, place.y), (true.x, true.y), 0.2):
            expected = f"current_pose at ({true.x:.2f}, {true.y:.2f}) m, at {row.stamp:.3g} s"
            hint = "current_pose is where the robot is in the map, not in its odometry: self.pose."
            return expected, f"({place.x:.2f}, {place.y:.2f}) m", hint
    return None


def _wrong_distance(run: Recording, goal: Goal) -> Fault | None:
    hint = "distance_remaining is the length of the path from the robot to its end, in meters."
    cells = cells_of(run.messages("/map", "/map_server")[0].message)
    mapped = np.array_equal(cells == 100, ground(run.world).occupied)
    for row in _before_a_touch(run, goal):
        distance, pose = row.message.distance_remaining, run.pose_at(row.stamp)
        shortest_way = to_go(world_in(run), pose)
        least = math.dist(goal_in(run), (pose.x, pose.y))
        if mapped:  # else the plan may lead through what no map shows
            least = max(least, shortest_way / 1.6)  # counting cells, diagonal ones too, gives 1 / 1.41 of it
        least, most = max(least - 0.5, 0.0), 1.5 * shortest_way + 0.5
        if not least <= distance <= most:
            expected = f"distance_remaining from {least:.2f} to {most:.2f} m at {row.stamp:.3g} s"
            return expected, f"{distance:.2f} m", hint
    return None


def _before_a_touch(run: Recording, goal: Goal) -> list[Message]:
    """The feedback before the first touch: from then on the odometry is wrong."""
    touched = run.contacts[0].stamp if run.contacts else math.inf
    return [row for row in goal.feedback if row.stamp < touched]


def _no_estimate(goal: Goal) -> Fault | None:
    """Feedback that says on the way that no time is left."""
    times = [in_seconds(row.message.estimated_time_remaining) for row in goal.feedback]
    if all(seconds > 0 for seconds in times[: len(times) // 2]):
        return None
    hint = (
        "It is the distance divided by the speed, as a message: Duration(seconds=distance / speed).to_msg()."
    )
    return "an estimated_time_remaining above 0 on the way", "0 s or less", hint
