"""Fifty short drives of a robot whose wheels slip: what its encoders read, and where it really went."""

from __future__ import annotations

import functools
from typing import NamedTuple

import numpy as np
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty

from grader.companions.tape import Row, Tape
from grader.worlds.slippery import SLIP
from sim.world.robot import RobotModel

WITH_JUDGE = True

DRIVES, STEPS, PERIOD = 50, 48, 0.1  # s between two messages
RADIUS, TRACK = RobotModel.wheel_radius, RobotModel.track_width
PAUSE = 4  # ticks from a reset to the first message after it
TICKS = PAUSE + STEPS + 2  # of a drive
LEAD = 10  # ticks before the first
SAMPLES = 400  # of each drive, for the spread of its ends
FAIR = 0.92, 1.08  # the mean of the normalized squared errors over its expectation
NAMES = ["wheel_left_joint", "wheel_right_joint"]


class ShortDrive(NamedTuple):
    """One drive.

    rolled: what the encoders read in each step, left and right (m). believed: poses by these readings.
    end: the true pose at the end. spread: the covariance of such ends.
    """

    rolled: np.ndarray
    believed: np.ndarray
    end: np.ndarray
    spread: np.ndarray


@functools.lru_cache(maxsize=4)
def drives(seed: int) -> tuple[ShortDrive, ...]:
    """The drives of a seed. Their errors are neither small nor large by chance, taken together."""
    rng = np.random.default_rng([seed, 143])
    rolled = [_rolled(rng) for _ in range(DRIVES)]
    believed = [_poses(each[None])[0] for each in rolled]
    samples = [_ends(each, rng, SAMPLES) for each in rolled]
    spreads = [np.cov((ends - believed_[-1]).T) for ends, believed_ in zip(samples, believed, strict=True)]
    while True:
        ends = [_ends(each, rng, 1)[0] for each in rolled]
        off = [end - path[-1] for end, path in zip(ends, believed, strict=True)]
        whole = np.mean([e @ np.linalg.solve(s, e) for e, s in zip(off, spreads, strict=True)]) / 3
        yaw = np.mean([e[2] ** 2 / s[2, 2] for e, s in zip(off, spreads, strict=True)])
        if all(FAIR[0] < part < FAIR[1] for part in (whole, yaw)):
            return tuple(map(ShortDrive, rolled, believed, ends, spreads))


def _rolled(rng: np.random.Generator) -> np.ndarray:
    """Draw how far the wheels roll in each step: straight, in a curve or backwards, with a stop."""
    steps: list[tuple[float, float]] = []
    stop = int(rng.integers(8, 25))
    while len(steps) < STEPS:
        speed, turn = rng.uniform(0.25, 0.6) * rng.choice((1, 1, 1, -1)), rng.choice((0, 0, 1, -1))
        steps += [(speed, turn * rng.uniform(0.3, 1.2))] * int(rng.integers(8, 25))
    steps[stop : stop + 8] = [(0.0, 0.0)] * 8
    moves = np.array([(0.0, 0.0), *steps[: STEPS - 1]])
    return np.asarray((moves[:, :1] + moves[:, 1:] * np.array([-TRACK / 2, TRACK / 2])) * PERIOD)


def _ends(rolled: np.ndarray, rng: np.random.Generator, number: int) -> np.ndarray:
    """The ends of so many robots that read the same and slip differently."""
    noise = SLIP * np.sqrt(np.abs(rolled)) * rng.standard_normal((number, *rolled.shape))
    return _poses(rolled + noise)[:, -1]


def _poses(rolled: np.ndarray) -> np.ndarray:
    """The pose after each step: x, y (m) and yaw (rad, not wrapped); shape (robots, steps, 3)."""
    turns, distances = (rolled[..., 1] - rolled[..., 0]) / TRACK, rolled.mean(axis=-1)
    yaws = np.cumsum(turns, axis=-1)
    middles = yaws - turns / 2
    x, y = (np.cumsum(distances * part, axis=-1) for part in (np.cos(middles), np.sin(middles)))
    return np.stack([x, y, yaws], axis=-1)


class Encoders(Tape):
    """Publishes /reset_odometry (Empty) before each drive, and /joint_states ten times a second in it."""

    def __init__(self, seed: int) -> None:
        rows: dict[int, list[Row]] = {}
        angles = np.zeros(2)
        for number, drive in enumerate(drives(seed)):
            begin = LEAD + number * TICKS
            rows[begin] = [("/reset_odometry", Empty(), 0)]
            for step, rolled in enumerate(drive.rolled):
                angles = angles + rolled / RADIUS
                rates = (rolled / RADIUS / PERIOD).tolist()
                joints = JointState(name=NAMES, position=angles.tolist(), velocity=rates)
                joints.header.frame_id = "base_link"
                rows[begin + PAUSE + step] = [("/joint_states", joints, 0)]
        types = {"/reset_odometry": Empty, "/joint_states": JointState}
        super().__init__("encoders", round(PERIOD * 1e9), types, rows)


def encoders(seed: int) -> list[functools.partial[Encoders]]:
    """The companions of a run."""
    return [functools.partial(Encoders, seed)]


SECONDS = (LEAD + DRIVES * TICKS) * PERIOD
