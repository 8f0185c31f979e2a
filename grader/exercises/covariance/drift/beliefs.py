"""The beliefs of a node after a drive, and how well they fit where the robot really is."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from grader.exercises.covariance.drift.short_drives import ShortDrive

AXES = np.ix_((0, 1, 5), (0, 1, 5))  # x, y and yaw in the 6 x 6 numbers
TINY = 1e-9  # m^2: a variance below is none
SAME = 1e-3  # relative
SINGULAR = 0.02  # of variances: what rounding may leave below zero


class Belief(NamedTuple):
    """The messages for one drive: poses, shape (steps, 3), and covariances, (steps, 6, 6)."""

    drive: ShortDrive
    poses: np.ndarray
    covariances: np.ndarray

    @property
    def error(self) -> np.ndarray:
        """The difference of the true pose to the last one."""
        off = self.drive.end - self.poses[-1]
        return np.array([*off[:2], math.remainder(off[2], math.tau)])

    @property
    def covariance(self) -> np.ndarray:
        """The last covariance, of x, y and yaw."""
        return np.asarray(self.covariances[-1][AXES])

    def score(self, covariance: np.ndarray) -> float:
        """The log score, -log of the density at the true pose, with another covariance; inf if it is none."""
        sign, size = np.linalg.slogdet(math.tau * covariance)
        if sign <= 0 or not math.isfinite(size):
            return math.inf
        return float(self.error @ np.linalg.solve(covariance, self.error) + size) / 2


def pose_of(pose: Any) -> tuple[float, float, float]:
    """x, y (m) and yaw (rad) of a message."""
    turn = pose.orientation
    return pose.position.x, pose.position.y, 2 * math.atan2(turn.z, turn.w)


def text_of(pose: np.ndarray) -> str:
    """A pose as text."""
    x, y, yaw = pose
    wrapped = math.remainder(yaw, math.tau) if math.isfinite(yaw) else yaw
    return f"x {x:.3f} m, y {y:.3f} m, yaw {wrapped:.3f} rad"


def median(beliefs: list[Belief], index: int) -> float:
    """The median of a number of the last covariances."""
    return float(np.median([belief.covariances[-1].flat[index] for belief in beliefs]))


def is_covariance(part: np.ndarray, least: float) -> bool:
    """Return whether it is symmetric and has no negative eigenvalue, and variances above `least`."""
    sizes = np.sqrt(np.maximum(np.diag(part), TINY))
    scaled = part / sizes[:, None] / sizes
    if not (np.diag(part) > least).all() or not (np.abs(scaled - scaled.T) <= SAME).all():
        return False
    return bool(np.linalg.eigvalsh(scaled).min() > -SINGULAR)


def nees(beliefs: list[Belief]) -> float:
    """The mean squared error in units of a covariance."""
    each = [belief.error @ np.linalg.pinv(belief.covariance) @ belief.error for belief in beliefs]
    return float(np.mean(each))


def yaw_nees(beliefs: list[Belief]) -> float:
    """The mean squared error of yaw in units of its variance."""
    return float(np.mean([belief.error[2] ** 2 / belief.covariance[2, 2] for belief in beliefs]))


def ratio(beliefs: list[Belief], axis: int) -> float:
    """The median of a variance over what it should be."""
    return float(np.median([each.covariance[axis, axis] / each.drive.spread[axis, axis] for each in beliefs]))


def is_turned(beliefs: list[Belief], bounds: tuple[float, float]) -> bool:
    """Return whether the errors fit the ellipses once these are turned by the yaw."""
    found = []
    for belief in beliefs:
        yaw = belief.poses[-1][2]
        turn = np.eye(3)
        turn[:2, :2] = [[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]]
        found.append(belief._replace(covariances=np.array([_whole(turn @ belief.covariance @ turn.T)])))
    return bounds[0] < nees(found) < bounds[1]


def _whole(part: np.ndarray) -> np.ndarray:
    whole = np.zeros((6, 6))
    whole[AXES] = part
    return whole
