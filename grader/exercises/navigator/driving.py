"""Exercises without a map: how far and where the goal is, and to drive there."""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable
from typing import NamedTuple

from grader.checks import (
    Missed,
    arrives,
    ends_with_a_stop,
    hinting,
    lasts,
    publishes,
    series,
    stands_still,
    travelled,
    usual_mistake,
)
from grader.exercise import Exercise
from grader.exercises.navigator.measures import tenths
from grader.exercises.navigator.partners import Wanderer
from sim.evidence import Pose, Recording, Seconds

GOAL = (5.0, 5.0)
FLOAT, TWIST = "std_msgs/msg/Float64", "geometry_msgs/msg/Twist"
DISTANCE, BEARING = "/goal/distance", "/goal/bearing"

Spot = tuple[float, float, float]  # x, y (m) and yaw (rad), by the odometry
Formula = Callable[[Spot], float]


class Told(NamedTuple):
    """A value that the node told, and where the robot was by its odometry then, or just before."""

    stamp: Seconds
    value: float
    near: list[Spot]

    def fits(self, formula: Formula, tolerance: float, modulo: float = math.inf) -> bool:
        """Is it what the formula gives?"""
        return math.isfinite(self.value) and any(
            abs(math.remainder(self.value - formula(spot), modulo)) <= tolerance for spot in self.near
        )


compass = Exercise(
    "compass", "Distance and bearing", world="yard", seconds=20, companions=[Wanderer], seeds=(1, 2)
)


@compass.check(2)
def tells_both(run: Recording) -> tuple[list[Told], list[Told]]:
    """The node publishes Float64 messages on /goal/distance and on /goal/bearing."""
    with hinting(guess="Publish both in the callback of /odom: msg = Float64(data=...)."):
        for topic in (DISTANCE, BEARING):
            publishes(run, topic, FLOAT, at_least=20)
    spots = _odometry(run)
    return _told(run, DISTANCE, spots), _told(run, BEARING, spots)


@compass.check(4, after=tells_both)
def tells_the_distance(run: Recording, told: tuple[list[Told], list[Told]]) -> None:
    """/goal/distance is the distance from the robot to (5, 5), in metres, within 5 cm."""
    distances, _ = told
    _agrees(distances, _distance, 0.05, "m", _WRONG_DISTANCES)
    lasts(run, DISTANCE)


@compass.check(6, after=tells_both)
def tells_the_bearing(run: Recording, told: tuple[list[Told], list[Told]]) -> None:
    """/goal/bearing is how far the robot must turn to face (5, 5): -pi to pi rad, positive to the left."""
    _, bearings = told
    try:
        _agrees(bearings, _bearing, 0.1, "rad", _WRONG_BEARINGS)
    except Missed as missed:
        if all(one.fits(_bearing, 0.1, math.tau) for one in bearings):
            missed.hint = (
                "It is right but for whole turns: math.remainder(angle, math.tau) brings it to -pi..pi."
            )
            missed.credit = 0.5
        raise
    lasts(run, BEARING)


def _agrees(
    told: list[Told], right: Formula, tolerance: float, unit: str, mistakes: dict[str, Formula]
) -> None:
    wrong = [one for one in told if not one.fits(right, tolerance)]
    if wrong:
        stamp, value, near = wrong[0]
        x, y, yaw = near[-1]
        usual = usual_mistake(mistakes, lambda formula: all(one.fits(formula, tolerance) for one in told))
        raise Missed(
            f"{right(near[-1]):.3g} {unit} from ({x:.2f}, {y:.2f}) m with yaw {yaw:.2f} rad",
            f"{value:.3g} at {stamp:.3g} s; {len(wrong)} of {len(told)} are wrong",
            guess=usual or "Print x, y and yaw in the callback, and work one out by hand.",
        )


def _distance(spot: Spot) -> float:
    return math.dist(GOAL, spot[:2])


def _direction(spot: Spot) -> float:
    return math.atan2(GOAL[1] - spot[1], GOAL[0] - spot[0])


def _bearing(spot: Spot) -> float:
    return math.remainder(_direction(spot) - spot[2], math.tau)


_WRONG_DISTANCES: dict[str, Formula] = {
    "math.hypot takes the differences to the goal: math.hypot(goal x - x, goal y - y).": (
        lambda spot: math.hypot(*spot[:2])
    ),
    "A distance along both axes, one after the other, is too long: use math.hypot.": (
        lambda spot: abs(GOAL[0] - spot[0]) + abs(GOAL[1] - spot[1])
    ),
    "The square root is missing: math.hypot(dx, dy) does it all.": lambda spot: _distance(spot) ** 2,
    "This is the bearing: first comes the distance, then the bearing.": _bearing,
}
_WRONG_BEARINGS: dict[str, Formula] = {
    "This is the direction of the goal in the world; take the robot's yaw away.": _direction,
    "The sign is wrong: the goal's direction minus the robot's yaw, so that left is positive.": (
        lambda spot: -_bearing(spot)
    ),
    "The unit is rad, not degrees.": lambda spot: math.degrees(_bearing(spot)),
    "This is the distance: first comes the distance, then the bearing.": _distance,
    "It points away from the goal: dx and dy are the goal minus the robot.": (
        lambda spot: math.remainder(_bearing(spot) + math.pi, math.tau)
    ),
    "A whole turn is math.tau: math.remainder(angle, math.pi) takes half turns away, too.": (
        lambda spot: math.remainder(_bearing(spot), math.pi)
    ),
    "math.atan2 takes dy first, then dx.": (
        lambda spot: math.remainder(math.pi / 2 - _direction(spot) - spot[2], math.tau)
    ),
    "orientation.z is no angle: yaw = 2 * math.atan2(orientation.z, orientation.w).": (
        lambda spot: math.remainder(_direction(spot) - math.sin(spot[2] / 2), math.tau)
    ),
    "math.atan(dy / dx) and the like lose half of the directions: use math.atan2(dy, dx).": (
        lambda spot: math.atan((GOAL[1] - spot[1]) / ((GOAL[0] - spot[0]) or 1e-9)) - spot[2]
    ),
}


def _told(run: Recording, topic: str, spots: list[tuple[Seconds, Spot]]) -> list[Told]:
    """The values of a topic, with the last three spots known then: a node may answer a little later."""
    found = []
    for stamp, value in series(run, topic, "data"):
        index = max(bisect.bisect_right(spots, stamp + 1e-6, key=lambda spot: spot[0]), 1)
        found.append(Told(stamp, value, [spot for _, spot in spots[max(index - 3, 0) : index]]))
    return found


def _odometry(run: Recording) -> list[tuple[Seconds, Spot]]:
    """Where the robot was by its odometry, with stamps."""
    found = []
    for heard in run.messages("/odom"):
        pose = heard.message.pose.pose
        yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        found.append((heard.stamp, (pose.position.x, pose.position.y, math.remainder(yaw, math.tau))))
    return found


WAY, NEAR, STOP = math.dist((0.0, 0.0), GOAL), 0.2, 0.1  # metres

drive = Exercise("drive", "To the goal", world="yard", seconds=60)


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
            credit=tenths(0.8 * (1 - _left(nearest) / WAY)),
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
    way = travelled(run.during(0.0, reached + 1e-6))
    if way > 1.15 * WAY:
        hint = "Turn towards the goal first; while the bearing is large, drive slowly or not at all."
        raise Missed(f"a way of {1.15 * WAY:.2f} m or less", f"{way:.2f} m", hint, picture="path")


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
    if way > WAY:
        return "It drives past the goal. Turn more for the same bearing, and go slowly while that is large."
    return f"It came {way:.2f} m far in {run.ended.stamp:.0f} s: 0.3 m/s or more is a good speed."
