"""Measures over where the robot really was: meters, map frame."""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterable, Sequence

import numpy as np

from grader.checks.check import Missed
from grader.diagnosis.driving import how_to_stop, last_command_that_moves
from sim.evidence import Pose, Recording, Seconds
from sim.world import World

Point = tuple[float, float]
_SHARES = (0.13, 0.37, 0.71, 1.0)  # of a time to look back; uneven, because a circle returns to its start


SLOW_DOWN = "Slow down or turn away earlier: /scan gives the distance to the nearest wall."


def world_in(recording: Recording) -> World:
    """Return the world of a scenario that has one."""
    assert recording.world is not None, "the scenario has a world"
    return recording.world


def goal_in(recording: Recording) -> Point:
    """Return the goal of a world that has one."""
    goal = world_in(recording).goal
    assert goal is not None, "the world has a goal"
    return goal


def keeps_clear(recording: Recording, hint: str = SLOW_DOWN) -> None:
    """The robot touches nothing. Raises Missed with the first touch, and this hint."""
    last_pose(recording)
    if recording.contacts:
        first, count = recording.contacts[0], len(recording.contacts)
        raise Missed(
            "no contact with walls or boxes",
            f"{count} {'contact' if count == 1 else 'contacts'}; the first at {first.stamp:.3g} s: "
            f"a {first.what} at ({first.x:.2f}, {first.y:.2f}) m, on the robot's {first.side} side",
            hint,
            picture="path",
            unsafe=True,
        )


def has_no_contacts(
    recording: Recording, hint: str = "", expected: str = "no contact with walls or boxes"
) -> None:
    """Raise Missed, as unsafe, with where the robot first touched something."""
    if recording.contacts:
        touch = recording.contacts[0]
        saw = f"a {touch.what} touched at {touch.stamp:.3g} s, at ({touch.x:.2f}, {touch.y:.2f}) m"
        raise Missed(expected, saw, hint, picture="path", unsafe=True)


def stood_still(recording: Recording, seconds: Seconds) -> bool:
    """Return whether the robot has not moved for so long; called often, so it compares a few poses only."""
    path = recording.path
    if path[-1].stamp < seconds:
        return False
    back = (round(len(path) / path[-1].stamp * seconds * share) for share in _SHARES)
    return all(math.dist(path[-1][1:3], path[max(-1 - steps, -len(path))][1:3]) < 1e-3 for steps in back)


def is_hopeless(recording: Recording, patience: Seconds) -> bool:
    """Return whether a run can end early: the robot never moves, or it touched something long ago.

    patience: seconds after a touch in which it may still get on.
    """
    touched = recording.contacts and recording.stamp > recording.contacts[0].stamp + patience
    return bool(touched) or stood_still(recording, 20.0)


def after_a_touch(recording: Recording) -> str:
    """Return why a robot loses its way that has touched something; "" where it hasn't."""
    if not recording.contacts:
        return ""
    touch = recording.contacts[0]
    return f"It drove into a {touch.what} at {touch.stamp:.3g} s, and its odometry has been wrong since."


def arrives(recording: Recording, goal: Point | None = None, *, tolerance: float = 0.1) -> float:
    """The distance in meters between where the robot ends and a goal; the world's own when none is given.

    Raises Missed when it's over `tolerance`. Raises ValueError when the world has no goal.
    """
    goal = goal or (recording.world.goal if recording.world else None)
    if goal is None:
        raise ValueError("there is no goal: give one, or use a world that has one")
    end = last_pose(recording)
    distance = math.dist(goal, (end.x, end.y))
    if distance > tolerance:
        raise Missed(
            f"the robot within {tolerance:g} m of ({goal[0]:g}, {goal[1]:g}) m at the end",
            f"({end.x:.2f}, {end.y:.2f}) m, which is {distance:.2f} m away",
            _movement_hint(recording),
            picture="path",
        )
    return distance


def passes(recording: Recording, points: Sequence[Point], *, tolerance: float = 0.1) -> None:
    """The robot passes the points one after the other; partial credit for those it reached.

    Raises Missed with the first point that it didn't come near.
    """
    last_pose(recording)
    path, reached = iter(recording.path), 0
    for point in points:
        if not any(math.dist(point, (pose.x, pose.y)) <= tolerance for pose in path):
            break
        reached += 1
    if reached < len(points):
        x, y = points[reached]
        later = " after that" if reached else ""
        raise Missed(
            f"the robot within {tolerance:g} m of {len(points)} points, one after the other",
            f"{reached or 'none'} of them; it never reached ({x:g}, {y:g}) m{later}",
            _movement_hint(recording),
            credit=reached / len(points),
            picture="path",
        )


def follows(recording: Recording, line: Sequence[Point], *, tolerance: float = 0.1) -> float:
    """The largest distance in meters from the path to a line through points. Raises Missed if too large."""
    last_pose(recording)
    distances = distances_to_line(np.array([(pose.x, pose.y) for pose in recording.path]), line)
    worst = int(np.argmax(distances))
    if distances[worst] > tolerance:
        pose = recording.path[worst]
        raise Missed(
            f"a path within {tolerance:g} m of the line",
            f"{distances[worst]:.2f} m away from it at {pose.stamp:.3g} s, at ({pose.x:.2f}, {pose.y:.2f}) m",
            _movement_hint(recording),
            picture="path",
        )
    return float(distances[worst])


def distances_to_line(points: np.ndarray, line: Sequence[Point]) -> np.ndarray:
    """Distances in meters of points, shape (n, 2), from a line through two points or more; shape (n,)."""
    corners = np.asarray(line)
    starts, spans = corners[:-1], np.diff(corners, axis=0)
    lengths = np.maximum((spans**2).sum(axis=1), 1e-12)
    offsets = points[:, None, :] - starts[None]
    along = np.clip((offsets * spans).sum(axis=2) / lengths, 0.0, 1.0)
    nearest: np.ndarray = np.linalg.norm(offsets - along[..., None] * spans, axis=2).min(axis=1)
    return nearest


def until_a_touch(recording: Recording) -> Recording:
    """The run until the robot touches something for the first time; the whole one where it doesn't."""
    return recording.during(0.0, recording.contacts[0].stamp) if recording.contacts else recording


def traveled(recording: Recording) -> float:
    """The length of the robot's path in meters."""
    return length(recording.path)


def length(path: Iterable[Pose]) -> float:
    """The length of a path in meters."""
    points = np.array([(pose.x, pose.y) for pose in path]).reshape(-1, 2)
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def stands_still(recording: Recording, *, last: Seconds = 0.5, tolerance: float = 0.005) -> None:
    """In the last seconds of the run the robot moves less than `tolerance`, in meters and radians.

    Raises Missed if not.
    """
    end = last_pose(recording)
    final = [pose for pose in recording.path if pose.stamp >= end.stamp - last]
    moved = max(math.dist((end.x, end.y), (pose.x, pose.y)) for pose in final)
    turned = max(abs(math.remainder(end.yaw - pose.yaw, math.tau)) for pose in final)
    if moved > tolerance or turned > tolerance:
        raise Missed(
            f"the robot standing still for the last {last:g} s",
            f"it moved {moved:.3f} m in that time" if moved > tolerance else f"it turned by {turned:.3f} rad",
            "Publish a Twist() with all zeros when the robot has arrived.",
            picture="path",
        )


def ends_with_a_stop(recording: Recording, *, credit: float = 0.0) -> None:
    """The last command on /cmd_vel is a stop: the robot doesn't stand only because it waits for another one.

    Raises Missed if not, with this credit.
    """
    left = last_command_that_moves(recording)
    if left:
        raise Missed("zeros as the last command", left, how_to_stop(recording), credit=credit)


def yaw_at(recording: Recording, stamp: Seconds) -> float:
    """Return the robot's true yaw at a time (degrees): of its last pose until then, as a node can know it."""
    index = bisect.bisect_right(recording.path, stamp + 1e-6, key=lambda pose: pose.stamp) - 1
    return math.degrees(recording.path[max(index, 0)].yaw)


def last_pose(recording: Recording) -> Pose:
    """Return where the robot is at the end. Raises ValueError for a run without a robot."""
    if not recording.path:
        raise ValueError("this run has no robot: give the exercise a world")
    return recording.path[-1]


def _movement_hint(recording: Recording) -> str:
    if traveled(recording) > 0.01:
        return ""
    if recording.messages("/cmd_vel"):
        return "The robot did not move: are linear.x (m/s) and angular.z (rad/s) of the Twist set?"
    return "The robot did not move: nothing was published on /cmd_vel."
