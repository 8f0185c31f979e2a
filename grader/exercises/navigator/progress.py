"""How far a goal of the navigator has come: the goal, the drive, and what is left of the way."""

from __future__ import annotations

import math
from typing import Any

from grader.checks import Missed
from grader.exercises.navigator.ground import ground, shortest
from sim.exchanges import Goal
from sim.recording import Heard, Pose, Recording, Seconds
from sim.world import World

ACTION, TYPE = "/navigate_to_pose", "nav2_msgs/action/NavigateToPose"

_SHARES = (0.13, 0.37, 0.71, 1.0)  # of a time to look back; uneven, for a circle comes back to its start
Fault = tuple[str, str, str]  # expected, saw, hint


def tenths(credit: float) -> float:
    """A share of a check's points, from 0 to 1 and in whole tenths, so that points are easy to read."""
    return min(max(math.floor(credit * 10 + 1e-9) / 10, 0.0), 1.0)


def stood_still(recording: Recording, seconds: Seconds) -> bool:
    """Whether the robot has not left its place for so long; asked often, so it looks at a few moments."""
    if recording.path[-1].stamp < seconds:
        return False
    x, y = recording.path[-1][1:3]
    back = [round(len(recording.path) / recording.path[-1].stamp * seconds * share) for share in _SHARES]
    places = [recording.path[max(-1 - steps, -len(recording.path))] for steps in back]
    return all(math.dist((x, y), place[1:3]) < 1e-3 for place in places)


def is_hopeless(recording: Recording, patience: Seconds) -> bool:
    """Whether a run can be ended early: the robot never moves, or it has touched something long ago.

    patience: seconds after a touch in which it may still get on.
    """
    touched = recording.contacts and recording.stamp > recording.contacts[0].stamp + patience
    return bool(touched) or stood_still(recording, 20.0)


def last_goal(recording: Recording) -> Goal:
    """The last goal that was sent. Raises Missed without one."""
    goals = recording.goals_of(ACTION)
    if not goals:
        raise Missed("a goal that is taken", "no server was there when the client looked for one")
    return goals[-1]


def end_of(recording: Recording, goal: Goal) -> Seconds:
    """When the goal was over, or the run."""
    return (goal.at(goal.status) if goal.over else None) or recording.path[-1].stamp


def drive_of(recording: Recording, goal: Goal) -> list[Pose]:
    """Where the robot was while the goal was worked on."""
    begin, end = goal.at("accepted") or 0.0, end_of(recording, goal)
    return [pose for pose in recording.path if begin <= pose.stamp <= end]


def least_way(recording: Recording) -> float:
    """The shortest way from where the robot stood when the goal was accepted (m)."""
    return max(to_go(recording.world, pose_at(recording, last_goal(recording).at("accepted") or 0.0)), 0.5)


def to_go(world: World, pose: Pose) -> float:
    """The shortest way from here to the world's goal (m); a large number where there is none."""
    floor = ground(world)
    column, row = floor.cell((pose.x, pose.y))
    return min(float(floor.to_goal()[row, column]), 2 * shortest(world))


def pose_at(recording: Recording, stamp: Seconds) -> Pose:
    """Where the robot really was at that time."""
    return next((pose for pose in recording.path if pose.stamp >= stamp - 1e-6), recording.path[-1])


def wrong_pose(recording: Recording, goal: Goal) -> Fault | None:
    """The first feedback that says that the robot is elsewhere."""
    for heard in _while_odometry_is_right(recording, goal):
        told, true = heard.message.current_pose.pose.position, pose_at(recording, heard.stamp)
        if math.dist((told.x, told.y), (true.x, true.y)) > 0.2:
            expected = f"current_pose at ({true.x:.2f}, {true.y:.2f}) m, at {heard.stamp:.3g} s"
            hint = "current_pose is where the robot is in the map, not by its odometry: self.pose."
            return expected, f"({told.x:.2f}, {told.y:.2f}) m", hint
    return None


def wrong_distance(recording: Recording, goal: Goal) -> Fault | None:
    """The first feedback whose distance can't be."""
    hint = "distance_remaining is the length of the path from the robot to its end, in metres."
    for heard in _while_odometry_is_right(recording, goal):
        told, pose = heard.message.distance_remaining, pose_at(recording, heard.stamp)
        way = to_go(recording.world, pose)
        least = math.dist(recording.world.goal, (pose.x, pose.y))
        if recording.world.name != "blocked":  # there the plan may lead through the box that no map knows
            least = max(least, way / 1.6)  # who counts cells, diagonal ones too, comes to 1 / 1.41 of the way
        least, most = max(least - 0.5, 0.0), 1.5 * way + 0.5
        if not least <= told <= most:
            expected = f"distance_remaining from {least:.2f} to {most:.2f} m at {heard.stamp:.3g} s"
            return expected, f"{told:.2f} m", hint
    return None


def _while_odometry_is_right(recording: Recording, goal: Goal) -> list[Heard]:
    """The feedback before the first touch: from then on nobody knows where the robot is."""
    touched = recording.contacts[0].stamp if recording.contacts else math.inf
    return [heard for heard in goal.feedback if heard.stamp < touched]


def no_estimate(goal: Goal) -> Fault | None:
    """A goal whose feedback says on the way that no time is left."""
    times = [_seconds(heard.message.estimated_time_remaining) for heard in goal.feedback]
    if all(seconds > 0 for seconds in times[: len(times) // 2]):
        return None
    hint = "It is the distance by the speed, as a message: Duration(seconds=distance / speed).to_msg()."
    return "an estimated_time_remaining above 0 on the way", "0 s or less", hint


def _seconds(duration: Any) -> Seconds:
    return duration.sec + duration.nanosec / 1e9
