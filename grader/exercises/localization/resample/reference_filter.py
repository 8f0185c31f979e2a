"""A particle filter with many particles: what a cloud should look like after what a run shows."""

import math
from typing import NamedTuple

import numpy as np

from grader.companions.map_messages import pose_2d
from grader.exercises.localization.resample.tour import RANGE_SPREAD
from grader.geometry import Pose2D
from sim.evidence import Recording, Seconds

ALONG, ASIDE = 0.02, 0.002  # m^2 for each m: variances of a drive, along and across the robot
TURN, BEND = 0.01, 0.002  # rad^2 for each rad turned, and for each m driven
STEP = 0.1  # m or rad after which a range counts again
COUNT = 4_000


class Shape(NamedTuple):
    """A cloud's mean (x, y, yaw), and its standard deviations along and across the robot (m) and of yaw."""

    mean: tuple[float, float, float]
    along: float
    across: float
    yaw: float


def shape_of(poses: np.ndarray, weights: np.ndarray) -> Shape:
    """Return the shape of a cloud. poses: x, y, yaw in rows. weights: with the sum 1."""
    sine, cosine = weights @ np.sin(poses[:, 2]), weights @ np.cos(poses[:, 2])
    x, y = weights @ poses[:, :2]
    yaw = math.atan2(sine, cosine)
    dx, dy = poses[:, 0] - x, poses[:, 1] - y
    turns = np.remainder(poses[:, 2] - yaw + math.pi, math.tau) - math.pi
    cos, sin = math.cos(yaw), math.sin(yaw)
    parts = cos * dx + sin * dy, cos * dy - sin * dx, turns
    return Shape((float(x), float(y), yaw), *(math.sqrt(max(weights @ part**2, 0.0)) for part in parts))


class ReferenceFilter:
    """Receives what a node receives, and moves and weighs many particles.

    along: the variance along the robot (m^2 for each m). turn: that of yaw (rad^2 for each rad turned).
    """

    def __init__(self, seed: int, along: float = ALONG, turn: float = TURN) -> None:
        self.rng, self.along, self.turn = np.random.default_rng(seed), along, turn
        self.poses = np.zeros((COUNT, 3))
        self.logs = np.zeros(COUNT)
        self.before: Pose2D | None = None
        self.weighed_at: Pose2D | None = None

    @property
    def shape(self) -> Shape:
        """The shape of its cloud."""
        weights = np.exp(self.logs - self.logs.max())
        return shape_of(self.poses, weights / weights.sum())

    def start(self, pose: tuple[float, float, float], covariance: np.ndarray) -> None:
        """Draw all particles around a pose."""
        index = np.ix_((0, 1, 5), (0, 1, 5))
        self.poses = self.rng.multivariate_normal(pose, np.reshape(covariance, (6, 6))[index], COUNT)
        self.logs[:] = 0.0

    def move(self, odometry: Pose2D) -> None:
        """Move each particle as the odometry moved, in its own direction."""
        before, self.before = self.before, odometry
        if before is None:
            return
        cos, sin = math.cos(before.yaw), math.sin(before.yaw)
        dx, dy = odometry.x - before.x, odometry.y - before.y
        turn = math.remainder(odometry.yaw - before.yaw, math.tau)
        if not (dx or dy or turn):
            return
        far, normal = math.hypot(dx, dy), self.rng.standard_normal((3, COUNT))
        ahead = cos * dx + sin * dy + math.sqrt(self.along * far) * normal[0]
        left = cos * dy - sin * dx + math.sqrt(ASIDE * far) * normal[1]
        yaw = self.poses[:, 2]
        self.poses[:, 0] += np.cos(yaw) * ahead - np.sin(yaw) * left
        self.poses[:, 1] += np.sin(yaw) * ahead + np.cos(yaw) * left
        self.poses[:, 2] += turn + math.sqrt(self.turn * abs(turn) + BEND * far) * normal[2]

    def weigh(self, beacon: tuple[float, float], distance: float) -> None:
        """Weigh the particles, if the robot has moved since the last time."""
        here, last = self.before, self.weighed_at
        if here is None:
            return
        if last is not None:
            turned = abs(math.remainder(here.yaw - last.yaw, math.tau))
            if math.dist(here[:2], last[:2]) < STEP and turned < STEP:
                return
        self.weighed_at = here
        distances = np.hypot(self.poses[:, 0] - beacon[0], self.poses[:, 1] - beacon[1])
        self.logs -= (distances - distance) ** 2 / (2 * RANGE_SPREAD**2)
        weights = np.exp(self.logs - self.logs.max())
        weights /= weights.sum()
        if 1 / (weights @ weights) < COUNT / 2:
            marks = (self.rng.random() + np.arange(COUNT)) / COUNT
            chosen = np.minimum(np.searchsorted(np.cumsum(weights), marks), COUNT - 1)
            self.poses, self.logs = self.poses[chosen], np.zeros(COUNT)


def shapes_at(run: Recording, stamps: list[Seconds], along: float, turn: float) -> list[Shape]:
    """Return the shapes that a cloud should have at these times, from the course's messages in a run.

    along, turn: variances, as a `ReferenceFilter` takes them.
    """
    point = run.messages("/beacon")[0].message.point
    topics = "/initialpose", "/odom", "/range"
    rows = sorted((row for topic in topics for row in run.messages(topic) if row.from_course),
                  key=lambda row: row.stamp)
    filtered = ReferenceFilter(0, along, turn)
    found: list[Shape] = []
    for row in rows:
        while len(found) < len(stamps) and stamps[len(found)] < row.stamp - 1e-6:
            found.append(filtered.shape)
        if row.topic == "/odom":
            filtered.move(Pose2D.from_message(row.message.pose.pose))
        elif row.topic == "/range":
            filtered.weigh((point.x, point.y), row.message.range)
        else:
            pose = row.message.pose
            filtered.start(pose_2d(pose.pose), np.array(pose.covariance))
    return found + [filtered.shape] * (len(stamps) - len(found))
