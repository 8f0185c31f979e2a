"""Exercise without a map: to drive to a goal."""

from __future__ import annotations

import math

from grader.checks import (
    Missed,
    arrives,
    ends_with_a_stop,
    hinting,
    publishes,
    series,
    stands_still,
    travelled,
)
from grader.checks.check import tenths
from grader.exercise import Exercise
from grader.exercises.navigator.bearing import GOAL
from grader.worlds.rooms import yard_from
from sim.evidence import Pose, Recording

TWIST = "geometry_msgs/msg/Twist"
NEAR, STOP = 0.2, 0.1  # metres

drive = Exercise("drive", "To the goal", world=yard_from, seconds=60, seeds=(1, 2), may_end=True)


@drive.check(1)
def sends_velocities(run: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(run, "/cmd_vel", TWIST)


@drive.check(7, after=sends_velocities)
def gets_there(run: Recording) -> None:
    """The robot comes within 20 cm of (5, 5)."""
    nearest = min(run.path, key=_left)
    if _left(nearest) > NEAR:
        raise Missed(
            "the robot within 0.2 m of (5, 5) m",
            f"{_left(nearest):.2f} m away at the nearest, at {nearest.stamp:.3g} s",
            guess=_why_not_there(run),
            credit=_credit(1 - _left(run.path[-1]) / _way(run)),
            picture="path",
        )


@drive.check(4, after=gets_there)
def stays_there(run: Recording) -> None:
    """In the end the robot stands still, within 20 cm of (5, 5)."""
    left = min(map(_left, run.path))
    guess = "Nearer than 0.1 m is near enough: then send a Twist() with zeros."
    if left > NEAR:
        guess = "First get there."
    elif left > STOP:
        guess = (
            f"It goes past the goal, {left:.2f} m beside it: turn more for the same bearing, or go slower."
        )
    with hinting(guess=guess):
        arrives(run, GOAL, tolerance=NEAR)
    stands_still(run)
    ends_with_a_stop(run)


@drive.check(2, after=gets_there)
def goes_straight(run: Recording) -> None:
    """The way to the goal is no more than 15 % longer than the straight line."""
    reached = next((pose.stamp for pose in run.path if _left(pose) <= NEAR), None)
    if reached is None:
        raise Missed("a way to (5, 5)", "the robot did not get there", "First get there.", picture="path")
    way, straight = travelled(run.during(0.0, reached + 1e-6)), _way(run)
    if way > 1.15 * straight:
        hint = "Turn towards the goal first; while the bearing is large, drive slowly or not at all."
        raise Missed(f"a way of {1.15 * straight:.2f} m or less", f"{way:.2f} m", hint, picture="path")


def _credit(come: float) -> float:
    """For the part of the way that was made in the end: a smaller one may have been made by chance."""
    return tenths(0.8 * come) if come >= 0.75 else 0.0


def _way(run: Recording) -> float:
    """The straight line from the start to the goal (m)."""
    return _left(run.path[0])


def _left(pose: Pose) -> float:
    """How far it is from here to the goal (m)."""
    return math.dist(GOAL, (pose.x, pose.y))


def _why_not_there(run: Recording) -> str:
    """The usual reasons for not getting there."""
    turns = [value for _, value in series(run, "/cmd_vel", "angular.z")]
    speeds = [value for _, value in series(run, "/cmd_vel", "linear.x")]
    if not any(turns) and any(speeds):
        return "The robot never turned: angular.z follows the bearing, such as 2.0 * bearing."
    if not any(speeds) and not any(turns):
        return "All commands are zeros; they should be only nearer than 0.1 m: is it > or <?"
    if not any(speeds):
        return "The robot was never told to go ahead: set linear.x (m/s)."
    if max(speeds) <= 0:
        return "It was told to go backwards: a positive linear.x goes ahead."
    if run.path[-1].stamp - run.messages("/cmd_vel")[-1].stamp > 1:
        return "The commands stopped too early. Send one with each /odom, until the robot is there."
    way, end = travelled(run), run.path[-1]
    if way < 0.5:
        return "It turns and turns. A positive bearing is to the left, and so is a positive angular.z."
    if speeds[-1] == 0.0:
        return f"It was told to stop at ({end.x:.2f}, {end.y:.2f}) m: linear.x became 0 there."
    if way > _way(run):
        return "It drives past the goal. Turn more for the same bearing, and go slowly while that is large."
    return f"It came {way:.2f} m far in {run.ended.stamp:.0f} s: 0.3 m/s or more is a good speed."
