"""A proper score of a cloud of particles: the logarithm of its density where the robot really is."""

import math
from typing import NamedTuple

import numpy as np

from grader.companions.map_messages import pose_2d
from grader.exercises.localization.kidnapped.hall import HALF_LENGTH, HALF_WIDTH, trip, twin
from grader.geometry import Pose2D
from sim.evidence import Recording, Seconds

KERNEL = 0.15, 0.15  # m and rad: the width of a particle's Gaussian kernel
FLOOR = 0.01  # the share of a density that is the same everywhere
EVERYWHERE = 1 / (4 * HALF_LENGTH * HALF_WIDTH * math.tau)  # that density (1 / (m^2 rad))


class LogScores(NamedTuple):
    """The scores of a cloud at the two poses that scans can't tell apart.

    off_middle: how far the robot is from the middle of the hall (m). here: the score at its pose. there: the
    score at the pose from which the hall looks the same.
    """

    stamp: Seconds
    off_middle: float
    here: float
    there: float


def log_score(poses: np.ndarray, weights: np.ndarray, truth: Pose2D) -> float:
    """Return the logarithm of a cloud's density at a pose, over that of a cloud that is all over the hall.

    poses: x, y (m) and yaw (rad) in rows. weights: with the sum 1.
    """
    far, wide = KERNEL
    gaps = ((poses[:, :2] - truth[:2]) ** 2).sum(axis=1) / (2 * far**2)
    turns = np.remainder(poses[:, 2] - truth.yaw + math.pi, math.tau) - math.pi
    kernels = np.exp(-gaps - turns**2 / (2 * wide**2)) / (math.tau * far**2 * math.sqrt(math.tau) * wide)
    density = (1 - FLOOR) * float(weights @ kernels) + FLOOR * EVERYWHERE
    return math.log(density / EVERYWHERE)


def log_scores(recording: Recording, apart: Seconds = 0.0) -> list[LogScores]:
    """Return the scores of the clouds on /particle_cloud, in a run in `carried_hall`.

    apart: a cloud that comes sooner after the last one with a score is left out.
    Raises ValueError for a cloud without particles, or whose weights don't have a positive sum.
    """
    middle = trip(recording.seed).middle
    found: list[LogScores] = []
    for row in recording.messages("/particle_cloud"):
        if found and row.stamp - found[-1].stamp < apart:
            continue
        poses = np.array([pose_2d(item.pose) for item in row.message.particles]).reshape(-1, 3)
        weights = np.array([item.weight for item in row.message.particles])
        if not weights.sum() > 0:
            raise ValueError(f"the cloud at {row.stamp:.3g} s has no particles with a weight")
        pose = recording.pose_at(row.stamp)
        truth = Pose2D(pose.x, pose.y, pose.yaw)
        scores = (log_score(poses, weights / weights.sum(), one) for one in (truth, twin(truth, middle)))
        found.append(LogScores(row.stamp, abs(truth.x - middle[0]), *scores))
    return found
