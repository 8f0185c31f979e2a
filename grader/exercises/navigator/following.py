"""Exercise on driving along a path."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from grader.checks import Missed, check, publishes, series, stands_still
from grader.checks.motion import distances_to_line
from grader.exercise import Exercise, Scenario
from grader.exercises.advice import advising
from grader.exercises.navigator.ground import drivable
from grader.exercises.navigator.partners import Localization, Planner, made_for
from grader.exercises.navigator.progress import is_hopeless, stood_still, tenths
from grader.exercises.navigator.worlds import world_of
from sim.recording import Recording

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
WINDOW = 1.0  # metres of the path in which its next point is looked for


@check(points=1)
def sends_commands(recording: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(recording, "/cmd_vel", TWIST)


@check(points=7, after=sends_commands)
def drives_along(recording: Recording) -> None:
    """The robot drives along the path to its end."""
    line, covered = _line(recording), _covered(recording)
    length = _length(line)
    if length - covered > NEAR:
        end = recording.path[-1]
        share = covered / length
        with advising(recording, _hint(recording)):
            raise Missed(
                f"the whole path, {length:.1f} m",
                f"{covered:.1f} m of it; the robot ends at ({end.x:.2f}, {end.y:.2f}) m",
                credit=tenths(0.8 * share),
                picture="path",
            )


@check(points=4, after=drives_along)
def keeps_near(recording: Recording) -> None:
    """On its way the robot stays within 12 cm of the path, and touches nothing."""
    if recording.contacts:
        touch = recording.contacts[0]
        saw = f"a {touch.what} touched at {touch.stamp:.3g} s, at ({touch.x:.2f}, {touch.y:.2f}) m"
        raise Missed("no contact with walls or boxes", saw, CORNERS, picture="path")
    off = distances_to_line(np.array([(pose.x, pose.y) for pose in recording.path]), _line(recording))
    worst = int(np.argmax(off))
    if off[worst] > OFF:
        pose = recording.path[worst]
        saw = f"{off[worst]:.3f} m off at {pose.stamp:.3g} s, at ({pose.x:.2f}, {pose.y:.2f}) m"
        credit = 0.5 if off[worst] < 2 * OFF else 0.0
        raise Missed(f"the robot within {OFF} m of the path", saw, CORNERS, credit=credit, picture="path")


@check(points=4, after=drives_along)
def stops_at_its_end(recording: Recording) -> None:
    """At the end of the path the robot stands still, within 15 cm of it."""
    end, last = _line(recording)[-1], recording.path[-1]
    left = math.dist(end, (last.x, last.y))
    if left > NEAR:
        hint = "When the robot is nearer than 0.1 m to the last point, send a Twist() with zeros."
        with advising(recording, hint):
            raise Missed(f"the robot within {NEAR} m of the path's end", f"{left:.2f} m away", picture="path")
    stands_still(recording)


def _line(recording: Recording) -> tuple[tuple[float, float], ...]:
    return drivable(recording.world)


def _length(line: tuple[tuple[float, float], ...]) -> float:
    return float(np.linalg.norm(np.diff(np.array(line), axis=0), axis=1).sum())


def _covered(recording: Recording) -> float:
    """How far along the path the robot came, in metres: point after point, so that nobody cuts it short."""
    line = np.array(_line(recording))
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    reached = 0
    for pose in recording.path:
        ahead = int(np.searchsorted(along, along[reached] + WINDOW))
        gaps = np.hypot(line[reached : ahead + 1, 0] - pose.x, line[reached : ahead + 1, 1] - pose.y)
        near = np.nonzero(gaps <= gaps.min() + 1e-9)[0][-1]
        if gaps[near] < LOST:
            reached += int(near)
    return float(along[reached])


def _hint(recording: Recording) -> str:
    """The usual reasons for not getting along."""
    turns = [value for _, value in series(recording, "/cmd_vel", "angular.z")]
    speeds = [value for _, value in series(recording, "/cmd_vel", "linear.x")]
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
    if recording.contacts:
        touch = recording.contacts[0]
        return f"It drove into a {touch.what} at {touch.stamp:.3g} s: the picture shows where. {CORNERS}"
    if speeds[-1] == 0.0 and not turns[-1]:
        return "It was told to stop before the end: 0.1 m from the last point is near enough."
    return "Draw the point ahead: it has to lie on the path, a little farther on than the robot."


def _settled(recording: Recording) -> bool:
    """The robot has stood still at the goal for 2 s, or nothing more will come of it."""
    end = recording.path[-1]
    at_goal = math.dist(recording.world.goal, (end.x, end.y)) < NEAR
    return (at_goal and stood_still(recording, 2.0)) or is_hopeless(recording, patience=10.0)


def _scenario(kind: str, seed: int) -> Scenario:
    def companions(seed: int) -> list[Any]:
        world = world_of(kind, seed)
        return [made_for(Planner, world=world), made_for(Localization, start=world.start)]

    return Scenario(lambda seed: world_of(kind, seed), 90, seed, companions, _settled)


follow = Exercise(
    "follow",
    "Along the path",
    [sends_commands, drives_along, keeps_near, stops_at_its_end],
    scenarios=[_scenario("clutter", 2), _scenario("maze", 1)],
)
