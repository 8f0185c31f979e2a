"""How far a goal of the navigator has come: the goal, what is left of the way, and what is told of it."""

from __future__ import annotations

import math

import numpy as np

from grader.checks import Missed
from grader.geometry.ground import ground, shortest
from grader.geometry.occupancy import cells_of
from sim.evidence import Goal, Message, Pose, Recording, Seconds
from sim.nanoseconds import in_seconds
from sim.world import World

ACTION, TYPE = "/navigate_to_pose", "nav2_msgs/action/NavigateToPose"

Fault = tuple[str, str, str]  # expected, saw, hint


def goals_of(run: Recording) -> list[Goal]:
    """The goals that our client sent. Raises Missed without one."""
    goals = [goal for goal in run.goals_of(ACTION) if goal.requested_by_course]
    if not goals:
        raise Missed("a goal that is taken", "no server was there when the client looked for one")
    return goals


def end_of(run: Recording, goal: Goal) -> Seconds:
    """When the goal was over, or the run."""
    return run.path[-1].stamp if goal.ended is None else goal.ended


def to_go(world: World, pose: Pose) -> float:
    """The shortest way from here to the world's goal (m); a large number where there is none."""
    floor = ground(world)
    column, row = floor.cell((pose.x, pose.y))
    return min(float(floor.to_goal()[row, column]), 2 * shortest(world))


def wrong_pose(run: Recording, goal: Goal) -> Fault | None:
    """The first feedback that says that the robot is elsewhere."""
    for heard in _while_odometry_is_right(run, goal):
        told, true = heard.message.current_pose.pose.position, run.pose_at(heard.stamp)
        if not math.dist((told.x, told.y), (true.x, true.y)) <= 0.2:  # so that NaN doesn't pass
            expected = f"current_pose at ({true.x:.2f}, {true.y:.2f}) m, at {heard.stamp:.3g} s"
            hint = "current_pose is where the robot is in the map, not by its odometry: self.pose."
            return expected, f"({told.x:.2f}, {told.y:.2f}) m", hint
    return None


def wrong_distance(run: Recording, goal: Goal) -> Fault | None:
    """The first feedback whose distance can't be."""
    hint = "distance_remaining is the length of the path from the robot to its end, in metres."
    mapped = _is_mapped(run)
    for heard in _while_odometry_is_right(run, goal):
        told, pose = heard.message.distance_remaining, run.pose_at(heard.stamp)
        way = to_go(run.world, pose)
        least = math.dist(run.world.goal, (pose.x, pose.y))
        if mapped:  # else the plan may lead through what no map knows
            least = max(least, way / 1.6)  # who counts cells, diagonal ones too, comes to 1 / 1.41 of the way
        least, most = max(least - 0.5, 0.0), 1.5 * way + 0.5
        if not least <= told <= most:
            expected = f"distance_remaining from {least:.2f} to {most:.2f} m at {heard.stamp:.3g} s"
            return expected, f"{told:.2f} m", hint
    return None


def _is_mapped(run: Recording) -> bool:
    """Whether the map shows all that stands in the world."""
    cells = cells_of(run.messages("/map", "/map_server")[0].message)
    return np.array_equal(cells == 100, ground(run.world).occupied)


def _while_odometry_is_right(run: Recording, goal: Goal) -> list[Message]:
    """The feedback before the first touch: from then on nobody knows where the robot is."""
    touched = run.contacts[0].stamp if run.contacts else math.inf
    return [heard for heard in goal.feedback if heard.stamp < touched]


def no_estimate(goal: Goal) -> Fault | None:
    """A goal whose feedback says on the way that no time is left."""
    times = [in_seconds(heard.message.estimated_time_remaining) for heard in goal.feedback]
    if all(seconds > 0 for seconds in times[: len(times) // 2]):
        return None
    hint = "It is the distance by the speed, as a message: Duration(seconds=distance / speed).to_msg()."
    return "an estimated_time_remaining above 0 on the way", "0 s or less", hint
