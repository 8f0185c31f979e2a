"""Validates goals of follow_joint_trajectory; an invalid goal is rejected with a one-sentence reason."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

from control_msgs.msg import JointTolerance

from sim.nanoseconds import SECOND, in_seconds
from sim.world.machines import JointModel, Waypoint

Goal: TypeAlias = Any  # FollowJointTrajectory.Goal, which has no types
GOAL_TOLERANCE = 0.01
"""Default goal tolerance of a joint (rad)."""


class RejectedGoal(Exception):
    """An invalid goal: the name of its error code in FollowJointTrajectory, and the reason."""

    def __init__(self, code: str, reason: str) -> None:
        super().__init__(reason)
        self.code = code


class TrajectoryRequest(NamedTuple):
    """The content of a goal; joints in the arm's order, times in seconds.

    delay: until the trajectory begins; negative if it began in the past.
    path, goal: tolerance (rad) of each joint along the path and at the goal; inf for none.
    extra_time: time allowed beyond the trajectory's end; inf for no limit.
    """

    waypoints: list[Waypoint]
    delay: float
    path: list[float]
    goal: list[float]
    extra_time: float


def read_goal(goal: Goal, names: Sequence[str], joints: Sequence[JointModel], now: int) -> TrajectoryRequest:
    """Return the content of a goal; `now` is the node's time in nanoseconds. Raises RejectedGoal."""
    given = list(goal.trajectory.joint_names)
    if sorted(given) != sorted(names):
        raise RejectedGoal(
            "INVALID_JOINTS",
            f"its joint_names are {given}; name each of {', '.join(names)} once, in any order.",
        )
    order = [given.index(name) for name in names]
    waypoints = [
        _waypoint(number, point, order) for number, point in enumerate(goal.trajectory.points, start=1)
    ]
    _check_times(waypoints)
    _check_limits(waypoints, names, joints)
    extra = in_seconds(goal.goal_time_tolerance)
    return TrajectoryRequest(
        waypoints,
        _delay(goal, waypoints[-1].time, now),
        _tolerances("path_tolerance", goal.path_tolerance, names, math.inf),
        _tolerances("goal_tolerance", goal.goal_tolerance, names, GOAL_TOLERANCE),
        extra if extra > 0 else math.inf,
    )


def _waypoint(number: int, point: Any, order: Sequence[int]) -> Waypoint:
    """The point with its joints in the arm's order."""
    positions, velocities = list(point.positions), list(point.velocities)
    if not _are_numbers(positions, len(order)):
        raise _invalid(
            f"the positions of point {number} are {positions}; give one finite number (rad) for each joint."
        )
    if velocities and not _are_numbers(velocities, len(order)):
        raise _invalid(
            f"the velocities of point {number} are {velocities}; "
            "give none, or one finite number (rad/s) for each joint."
        )
    rates = tuple(velocities[index] for index in order) if velocities else None
    return Waypoint(in_seconds(point.time_from_start), tuple(positions[index] for index in order), rates)


def _check_times(waypoints: Sequence[Waypoint]) -> None:
    if not waypoints:
        raise _invalid("it has no points; give it at least one, with positions and time_from_start.")
    before = -math.inf
    for number, point in enumerate(waypoints, start=1):
        if point.time < 0 or point.time <= before:
            than = "0 or more" if point.time < 0 else f"more than {before:g} s, that of point {number - 1}"
            raise _invalid(f"time_from_start of point {number} is {point.time:g} s; make it {than}.")
        before = point.time


def _check_limits(waypoints: Sequence[Waypoint], names: Sequence[str], joints: Sequence[JointModel]) -> None:
    for number, point in enumerate(waypoints, start=1):
        for index, (name, joint) in enumerate(zip(names, joints, strict=True)):
            position, rate = point.positions[index], point.velocities[index] if point.velocities else 0.0
            if not joint.lower <= position <= joint.upper:
                raise _invalid(
                    f"point {number} has {name} at {position:g} rad; "
                    f"its limits are {joint.lower:g} and {joint.upper:g} rad."
                )
            if abs(rate) > joint.max_velocity:
                raise _invalid(
                    f"point {number} has {name} at {rate:g} rad/s; its limit is {joint.max_velocity:g} rad/s."
                )
    if any(waypoints[-1].velocities or ()):
        raise _invalid(
            "its last point has velocities; the arm stays there, so make them 0 or leave them out."
        )


def _delay(goal: Goal, end: float, now: int) -> float:
    """Seconds until the trajectory begins; a stamp of 0 means now."""
    stamp = goal.trajectory.header.stamp
    nanoseconds = stamp.sec * SECOND + stamp.nanosec
    delay = (nanoseconds - now) / SECOND if nanoseconds else 0.0
    if delay + end < 0:
        raise RejectedGoal(
            "OLD_HEADER_TIMESTAMP",
            f"by its header.stamp it ended {-delay - end:g} s ago; give it a stamp of 0 to begin at once.",
        )
    return delay


def _tolerances(
    field: str, given: Sequence[JointTolerance], names: Sequence[str], default: float
) -> list[float]:
    """The tolerance of each joint; in control_msgs, 0 means the default and a negative one means none."""
    tolerances = dict.fromkeys(names, default)
    for tolerance in given:
        if tolerance.name not in tolerances:
            raise RejectedGoal(
                "INVALID_JOINTS", f"{field} names {tolerance.name!r}; the joints are {', '.join(names)}."
            )
        if math.isnan(tolerance.position):
            raise _invalid(f"{field} of {tolerance.name} is nan; give a number of radians.")
        if tolerance.position:
            tolerances[tolerance.name] = tolerance.position if tolerance.position > 0 else math.inf
    return list(tolerances.values())


def _are_numbers(values: Sequence[float], count: int) -> bool:
    return len(values) == count and all(map(math.isfinite, values))


def _invalid(reason: str) -> RejectedGoal:
    return RejectedGoal("INVALID_GOAL", reason)
