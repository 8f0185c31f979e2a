"""Measures over machines with joints: where the links really were, and what the tip has drawn."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from grader.checks.check import Missed
from grader.checks.motion import Point, distances_to_line
from grader.checks.topics import series
from sim.evidence import Pose, Recording, Seconds

FOLLOW_TRAJECTORY = "/arm_controller/follow_joint_trajectory", "control_msgs/action/FollowJointTrajectory"
"""The action of an arm's driver, and its type."""


class JointLimits(NamedTuple):
    """The lowest and the highest position of a joint, rad."""

    lower: float
    upper: float

    def margin(self, position: float) -> float:
        """Return how far (rad) a position is from the nearer limit; below 0 beyond it."""
        return min(position - self.lower, self.upper - position)


def described_limits(recording: Recording) -> dict[str, JointLimits]:
    """The limits of each joint that has some, by the description that the course publishes."""
    text = next(row for row in recording.messages("/robot_description") if row.from_course).message.data
    joints = ElementTree.fromstring(text).iterfind("joint[limit]")
    limits = {joint.get("name", ""): joint.find("limit") for joint in joints}
    return {
        name: JointLimits(float(limit.get("lower", 0.0)), float(limit.get("upper", 0.0)))
        for name, limit in limits.items()
        if limit is not None
    }


def tip_path(recording: Recording) -> list[Pose]:
    """Return where the tip was, all the time. Raises ValueError for a run without an arm."""
    if not recording.tip:
        raise ValueError("this run has no arm: give the exercise a world with a machine made of links")
    return recording.tip


def tip_at(recording: Recording, stamp: Seconds) -> Pose:
    """Return where the tip was at a time: its last pose up to then, or its first.

    Of a single joint, yaw is its angle (rad).
    """
    path = tip_path(recording)
    return next((pose for pose in reversed(path) if pose.stamp <= stamp + 1e-6), path[0])


def commands_within(
    recording: Recording, topic: str, field: str, lower: float, upper: float, hint: str = ""
) -> None:
    """Nothing beyond a joint's limits (rad) is sent, nor anything that is not a number; else it is unsafe.

    Raises Missed with the first value outside, and this hint.
    """
    for stamp, value in series(recording, topic, field):
        if not lower <= value <= upper:
            raise Missed(
                f"commands from {lower:g} to {upper:g} rad on {topic}",
                f"{value:.4g} at {stamp:.3g} s",
                hint,
                picture="topics",
                unsafe=True,
            )


def keeps_off(recording: Recording, hint: str = "") -> None:
    """No link of the arm crosses a wall. Raises Missed with the first moment that one does, and this hint."""
    ends, world = tip_path(recording), recording.world
    assert world is not None, "an arm is in a world"
    bodies = [body.name for body in world.bodies]
    for index, end in enumerate(ends):
        places = [recording.tracks[name][index][1:3] for name in bodies] + [(end.x, end.y)]
        for name, begin, finish in zip(bodies, places, places[1:], strict=False):
            if any(_cross(begin, finish, *wall) for wall in world.walls):
                raise Missed(
                    "an arm that touches nothing",
                    f"its {name} in the wall at {end.stamp:.3g} s, between ({begin[0]:.2f}, {begin[1]:.2f}) "
                    f"and ({finish[0]:.2f}, {finish[1]:.2f}) m",
                    hint,
                    picture="path",
                    unsafe=True,
                )


def draws(recording: Recording, line: Sequence[Point], *, tolerance: float = 0.02, hint: str = "") -> float:
    """The tip goes along all of a line through points (m, map frame), and nowhere else once it has begun.

    Returns the largest distance (m) from the line since the tip came to its first point. Raises Missed
    with the part of the line that wasn't drawn, which is partial credit, or with the place where it left it.
    """
    path = tip_path(recording)
    tip = np.array([(pose.x, pose.y) for pose in path])
    wanted, drawn_points = _filled(line, tolerance / 2), _filled(tip, tolerance / 2)
    gaps = np.linalg.norm(wanted[:, None, :] - drawn_points[None], axis=2).min(axis=1)
    drawn = float((gaps <= tolerance).mean())
    if drawn < 1.0:
        x, y = wanted[int(np.argmax(gaps))]
        raise Missed(
            f"all of the figure within {tolerance * 100:g} cm of the tip's path",
            f"{drawn:.0%} of it; the tip never came closer than {gaps.max():.2f} m to ({x:.2f}, {y:.2f}) m",
            hint,
            credit=drawn if drawn > 0.5 else 0.0,
            picture="path",
        )
    begin = int(np.argmax(np.linalg.norm(tip - np.asarray(line[0]), axis=1) <= tolerance))
    away = distances_to_line(tip[begin:], line)
    worst = int(np.argmax(away))
    if away[worst] > tolerance:
        pose = path[begin + worst]
        raise Missed(
            f"a tip that stays within {tolerance * 100:g} cm of the figure once it has begun",
            f"{away[worst]:.2f} m away at {pose.stamp:.3g} s, at ({pose.x:.2f}, {pose.y:.2f}) m",
            hint,
            credit=0.5,
            picture="path",
        )
    return float(away[worst])


def _filled(line: Sequence[Point] | np.ndarray, step: float) -> np.ndarray:
    """Points on a line through points, at most `step` meters apart; shape (n, 2)."""
    points = [np.asarray(line[:1])]
    for begin, end in itertools.pairwise(line):
        count = math.ceil(math.dist(begin, end) / step)
        points.append(np.linspace(begin, end, count + 1)[1:])
    return np.concatenate(points)


def _cross(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Return whether the segments a-b and c-d cross."""

    def side(p: Point, q: Point, r: Point) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0
