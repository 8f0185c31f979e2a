"""How fast and how close: measures along a path of poses, in the map frame."""

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

from grader.checks.check import Missed
from grader.diagnosis.driving import still_obeyed
from grader.responses.window import Window
from sim.evidence import Pose, Recording, Seconds

STANDING, TURNING = 0.02, 0.1  # m/s and rad/s: slower is standing


class Speed(NamedTuple):
    """A mean speed between two poses in a row."""

    stamp: Seconds  # of the later pose
    linear: float  # m/s, never below 0
    angular: float  # rad/s, never below 0


def speeds(path: Sequence[Pose]) -> list[Speed]:
    """Return the speed between each two poses in a row."""
    return [
        Speed(
            after.stamp,
            math.dist(before[1:3], after[1:3]) / (after.stamp - before.stamp),
            abs(math.remainder(after.yaw - before.yaw, math.tau)) / (after.stamp - before.stamp),
        )
        for before, after in itertools.pairwise(path)
    ]


def top_speed(path: Sequence[Pose]) -> Speed:
    """Return the highest linear speed along a path; zeros for fewer than two poses."""
    return max(speeds(path), key=lambda speed: speed.linear, default=Speed(0.0, 0.0, 0.0))


def closest(path: Sequence[Pose], point: tuple[float, float]) -> tuple[float, Seconds]:
    """Return the smallest distance (m) of a path from a point, and when that was. Infinity for no poses."""
    return min(((math.dist(pose[1:3], point), pose.stamp) for pose in path), default=(math.inf, 0.0))


def require_standing(run: Recording, window: Window, why: str, hint: str) -> None:
    """Raise Missed, as unsafe, where the robot moves within a window.

    why: completes "the robot standing, ...".
    """
    for speed in speeds(window.rows(run.path)):
        if speed.linear > STANDING or speed.angular > TURNING:
            saw = f"{speed.linear:.2f} m/s and {speed.angular:.2f} rad/s at {speed.stamp:.3g} s"
            hint = still_obeyed(run, speed.stamp) or hint
            raise Missed(f"the robot standing still, {why}", saw, hint, picture="topics", unsafe=True)
