"""Exercise without a map: how far the goal is, and where."""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable
from typing import NamedTuple

from grader.checks import Missed, hinting, lasts, publishes, series, usual_mistake
from grader.companions.blind_drivers import Wanderer
from grader.exercise import Exercise
from sim.evidence import Recording, Seconds

GOAL = (5.0, 5.0)
FLOAT = "std_msgs/msg/Float64"
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
    "orientation.z is not an angle: yaw = 2 * math.atan2(orientation.z, orientation.w).": (
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
