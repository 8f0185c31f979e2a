"""Exercise on driving along a path."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from grader.checks import Missed, ends_with_a_stop, publishes, series, stands_still, until_a_touch
from grader.checks.check import tenths
from grader.checks.motion import distances_to_line, is_hopeless, stood_still
from grader.checks.motion import touches_nothing as keeps_off
from grader.companions.goals import Planner
from grader.companions.maps import Localization, made_for
from grader.exercise import Exercise, Scenario
from grader.geometry.ground import drivable
from grader.worlds.rooms import world_of
from sim.evidence import Recording

TWIST = "geometry_msgs/msg/Twist"
NEAR = 0.15  # metres from the path's end
# Metres from the path: pure pursuit stays within 9 cm in all worlds, and within 7 cm in a maze. With half the
# curvature it swings out of a maze's corners by 13 cm or more.
OFF = 0.12
LOST = 0.4  # metres from the path: what the robot passes farther away is not covered
CORNERS = (
    "Where it cuts a corner, look less far ahead. Where it swings out of one, it turns too little: curvature "
    "= 2 * sin(bearing) / distance, and on the spot while the bearing is above 1 rad, to both sides."
)
FASTEST = 1.0  # m/s that somebody may want
AHEAD = 0.3  # metres: how far ahead of the robot the assignment steers for
WINDOW = 1.0  # metres of the path in which its next point is looked for


def _settled(run: Recording) -> bool:
    """The robot has stood still at the goal for 2 s, or nothing more will come of it."""
    end = run.path[-1]
    at_goal = math.dist(run.world.goal, (end.x, end.y)) < NEAR
    return (at_goal and stood_still(run, 2.0)) or is_hopeless(run, patience=10.0)


def _scenario(kind: str, seed: int) -> Scenario:
    def companions(seed: int) -> list[Any]:
        world = world_of(kind, seed)
        return [made_for(Planner, world=world), made_for(Localization, start=world.start)]

    return Scenario(lambda seed: world_of(kind, seed), 90, seed, companions, _settled)


follow = Exercise(
    "follow", "Along the path", scenarios=[_scenario("clutter", 2), _scenario("maze", 1)], may_end=True
)


@follow.check(1)
def sends_commands(run: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(run, "/cmd_vel", TWIST)


@follow.check(7, after=sends_commands)
def drives_along(run: Recording) -> None:
    """The robot drives along the path to its end."""
    along = _along(run)
    covered, length = _covered(run, along), along[-1]
    if length - covered > NEAR:
        end = run.path[-1]
        raise Missed(
            f"the whole path, {length:.1f} m",
            f"{covered:.1f} m of it; the robot ends at ({end.x:.2f}, {end.y:.2f}) m",
            guess=_why_not_along(run),
            credit=tenths(0.8 * covered / length),
            picture="path",
        )


@follow.check(4, after=drives_along)
def keeps_near(run: Recording) -> None:
    """On its way the robot stays within 12 cm of the path, and touches nothing."""
    keeps_off(run, CORNERS)
    off = distances_to_line(np.array([(pose.x, pose.y) for pose in run.path]), _line(run))
    worst = int(np.argmax(off))
    if off[worst] > OFF:
        pose = run.path[worst]
        saw = f"{off[worst]:.3f} m off at {pose.stamp:.3g} s, at ({pose.x:.2f}, {pose.y:.2f}) m"
        credit = 0.5 if off[worst] < 2 * OFF else 0.0
        raise Missed(f"the robot within {OFF} m of the path", saw, CORNERS, credit=credit, picture="path")


@follow.check(4, after=drives_along)
def stops_at_its_end(run: Recording) -> None:
    """At the end of the path the robot stands still, within 15 cm of it."""
    end, last = _line(run)[-1], run.path[-1]
    left = math.dist(end, (last.x, last.y))
    if left > NEAR:
        guess = "When the robot is nearer than 0.1 m to the last point, send a Twist() with zeros."
        expected = f"the robot within {NEAR} m of the path's end"
        raise Missed(expected, f"{left:.2f} m away", guess=guess, picture="path")
    stands_still(run)
    ends_with_a_stop(run)


def _line(run: Recording) -> tuple[tuple[float, float], ...]:
    return drivable(run.world)


def _along(run: Recording) -> np.ndarray:
    """How far along the path each of its points lies, in metres."""
    steps = np.linalg.norm(np.diff(np.array(_line(run)), axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _covered(run: Recording, along: np.ndarray) -> float:
    """How far along the path the robot came, in metres: point after point, so that nobody cuts it short."""
    line = np.array(_line(run))
    reached = 0
    for pose in run.path:
        ahead = int(np.searchsorted(along, along[reached] + WINDOW))
        gaps = np.hypot(line[reached : ahead + 1, 0] - pose.x, line[reached : ahead + 1, 1] - pose.y)
        near = np.nonzero(gaps <= gaps.min() + 1e-9)[0][-1]
        if gaps[near] < LOST:
            reached += int(near)
    return float(along[reached])


def _why_not_along(run: Recording) -> str:
    """The usual reasons for not getting along."""
    turns = [value for _, value in series(run, "/cmd_vel", "angular.z")]
    speeds = [value for _, value in series(run, "/cmd_vel", "linear.x")]
    if not any(speeds) and any(turns):
        return "It only turns on the spot. A positive bearing is to the left, and so is a positive angular.z."
    if not any(speeds):
        return "The robot was never told to go ahead: linear.x is the speed, such as 0.4 m/s."
    if not any(turns) and max(speeds) <= FASTEST:
        return "The robot was never told to turn: angular.z is speed times curvature."
    if max(map(abs, turns)) < 0.05 and max(speeds) <= FASTEST:
        return "It hardly turns: the curvature is 2 * sin(bearing) / distance, with the bearing in rad."
    if len(set(turns)) <= 4 and len(set(speeds)) > 16:
        return "The speed changes all the time, and the turn doesn't: first comes the speed, then the turn."
    if max(speeds) > FASTEST:
        return f"A speed of {max(speeds):.3g} m/s: first comes the speed, then the turn; on the spot it is 0."
    if _trusts_odometry_alone(run):
        return (
            "It steers as if /odom, or the transform from odom to base_link, said where the robot is in the "
            "map. That is where it is since its start: put the transform from map to odom before it."
        )
    if run.contacts:
        touch = run.contacts[0]
        return f"It drove into a {touch.what} at {touch.stamp:.3g} s: the picture shows where. {CORNERS}"
    if speeds[-1] == 0.0 and not turns[-1]:
        return "It was told to stop before the end: 0.1 m from the last point is near enough."
    return "Draw the point ahead: it has to lie on the path, a little farther on than the robot."


def _trusts_odometry_alone(run: Recording) -> bool:
    """Whether it turns to where the path ahead would be, were the robot where its odometry has it."""
    fits_map, fits_odometry = [], []
    line, (x0, y0, yaw0) = np.array(_line(run)), run.world.start
    for stamp, turn in series(until_a_touch(run), "/cmd_vel", "angular.z"):
        _, x, y, yaw = run.pose_at(stamp)
        ahead, left = x - x0, y - y0
        cos, sin = math.cos(yaw0), math.sin(yaw0)
        odometry = cos * ahead + sin * left, cos * left - sin * ahead, yaw - yaw0
        if abs(turn) > 0.1:
            fits_map.append(turn * _bearing_ahead(line, x, y, yaw) > 0)
            fits_odometry.append(turn * _bearing_ahead(line, *odometry) > 0)
    return bool(fits_map) and np.mean(fits_odometry) > 0.9 > 0.7 > np.mean(fits_map)


def _bearing_ahead(line: np.ndarray, x: float, y: float, yaw: float) -> float:
    """Where the path ahead lies for a robot, in rad to its left."""
    distances = np.hypot(line[:, 0] - x, line[:, 1] - y)
    rest = slice(int(distances.argmin()), None)
    far = np.flatnonzero(distances[rest] >= AHEAD)
    to = line[rest][far[0] if len(far) else -1]
    return math.remainder(math.atan2(to[1] - y, to[0] - x) - yaw, math.tau)
