"""Short drives of many robots, as wheel odometry and a gyro: each with its errors, late, and with gaps."""

from __future__ import annotations

import functools
import math
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu
from std_msgs.msg import Empty

from grader.companions.tape import Row, Tape
from sim.world.robot import RobotModel

WITH_JUDGE = True

STREAMS, PERIOD, EVERY = 24, 0.1, 2  # s between two readings of the gyro; one of the wheels for so many
STEPS, TAIL = 80, 10  # ticks of a drive, and of the rest after it
SLIP, TRACK = 0.011, RobotModel.track_width  # m: standard deviation of a wheel's distance after 1 m; m
NOISE, BIAS = 0.015, 0.05  # rad/s: the gyro's noise, and the largest bias
PAUSE, LEAD = 6, 10  # ticks: from a reset to the first message, and before the first reset
TICKS = PAUSE + STEPS + TAIL + 2
LATE = 4  # ticks: the most for which a message is on its way
SECONDS = (LEAD + STREAMS * TICKS) * PERIOD
ROUGH = 1e-4  # rad: what the wheels' yaw is rounded to, as a standard deviation


class RobotStream(NamedTuple):
    """The sensor readings of one robot. All arrays have a row for each tick.

    yaws: the true ones, rad, not wrapped. speeds: m/s. gyro: readings, rad/s. wheels: yaws of the odometry,
    rad, with their variances `spread`. silent: the sensor that is silent for a while ("", "gyro",
    "wheels"), and its ticks. gyro_late, wheels_late: the ticks for which each reading is on its way.
    """

    yaws: np.ndarray
    speeds: np.ndarray
    gyro: np.ndarray
    wheels: np.ndarray
    spread: np.ndarray
    silent: str
    gap: range
    gyro_late: np.ndarray
    wheels_late: np.ndarray


@functools.lru_cache(maxsize=4)
def streams(seed: int) -> tuple[RobotStream, ...]:
    """The streams of a seed; taken together, their largest errors are neither small nor large by chance."""
    rng = np.random.default_rng([seed, 144])
    biases = rng.permutation(np.linspace(-BIAS, BIAS, STREAMS))
    quantiles = np.array([NormalDist().inv_cdf((number + 0.5) / STREAMS) for number in range(STREAMS)])
    quantiles /= math.sqrt(np.mean(quantiles**2))
    both = zip(biases, rng.permutation(quantiles), rng.permutation(quantiles), strict=True)
    return tuple(_stream(number, rng, *each) for number, each in enumerate(both))


def _stream(number: int, rng: np.random.Generator, bias: float, slipped: float, noise: float) -> RobotStream:
    """One robot. slipped, noise: the errors of wheels and gyro in the whole drive, over what is usual."""
    speeds, rates = _motion(rng, rests=number % 3 != 2)
    turns = rates * PERIOD
    turns[0] = 0.0  # a drive begins with the first measurement
    both = (np.abs(speeds + side * rates * TRACK / 2) for side in (-1, 1))
    rolled = sum(both, np.zeros(len(rates))) * PERIOD
    spread = SLIP**2 * rolled / TRACK**2
    spread[0] = 0.0
    gyro = rates + bias + _noise(rng, np.full(len(rates), NOISE**2), noise)
    wheels = turns + _noise(rng, spread, slipped)
    silent = ("", "wheels", "", "gyro")[number % 4]
    begin = int(rng.integers(24, 40))
    late = rng.integers(1, LATE, STEPS + TAIL)
    return RobotStream(
        np.cumsum(turns), speeds, gyro, np.cumsum(wheels), np.cumsum(spread),
        silent, range(begin, begin + {"wheels": 20, "gyro": 15}.get(silent, 0)), _stalls(rng), late,
    )  # fmt: skip


def _motion(rng: np.random.Generator, rests: bool) -> tuple[np.ndarray, np.ndarray]:
    """Speeds (m/s) and yaw rates (rad/s): from rest, or in a turn from the beginning; it ends at rest."""
    side = rng.choice((-1, 1))
    plan = [(0.0, 0.0)] * 12 if rests else [(0.3, side * rng.uniform(0.6, 1.2))] * 14
    while len(plan) < STEPS - 14:
        turn = rng.choice((side, side, side, 0)) * rng.uniform(0.5, 1.3)
        plan += [(rng.uniform(0.2, 0.45), turn)] * int(rng.integers(8, 17))
    plan = [*plan[: STEPS - 14], *[(0.3, 0.0)] * 12, *[(0.0, 0.0)] * (TAIL + 2)]
    moves, now = [], np.array(plan[0])
    for wanted in plan:
        now = now + np.clip(np.array(wanted) - now, (-0.2, -0.4), (0.2, 0.4))
        moves.append(now)
    speeds, rates = np.array(moves).T
    return speeds, rates


def _noise(rng: np.random.Generator, variances: np.ndarray, total: float) -> np.ndarray:
    """Independent normal errors of these variances whose sum is `total` of its standard deviations."""
    drawn = rng.standard_normal(len(variances)) * np.sqrt(variances)
    off = total * math.sqrt(variances.sum()) - drawn.sum()
    return np.asarray(drawn + off * variances / variances.sum())


def _stalls(rng: np.random.Generator) -> np.ndarray:
    """The ticks for which each reading of the gyro is on its way: at times several arrive together."""
    late = np.zeros(STEPS + TAIL, dtype=int)
    begin = int(rng.integers(2, 6))
    while begin + LATE < len(late):
        late[begin : begin + LATE + 1] = range(LATE, -1, -1)
        begin += LATE + int(rng.integers(3, 9))
    return late


class Robots(Tape):
    """Publishes /reset_odometry (Empty) before each drive, and /odom and /imu/data in it."""

    def __init__(self, seed: int) -> None:
        rows: dict[int, list[Row]] = {}
        for number, stream in enumerate(streams(seed)):
            begin = LEAD + number * TICKS
            rows.setdefault(begin, []).append(("/reset_odometry", Empty(), 0))
            begin += PAUSE
            for tick in range(len(stream.yaws)):
                in_gap = tick in stream.gap
                if tick % EVERY == 0 and not (in_gap and stream.silent == "wheels"):
                    late = int(stream.wheels_late[tick])
                    rows.setdefault(begin + tick + late, []).append(("/odom", _odom(stream, tick), late))
                if not (in_gap and stream.silent == "gyro"):
                    late = int(stream.gyro_late[tick])
                    rows.setdefault(begin + tick + late, []).append(("/imu/data", _imu(stream, tick), late))
        types = {"/reset_odometry": Empty, "/odom": Odometry, "/imu/data": Imu}
        super().__init__("robots", round(PERIOD * 1e9), types, rows)


def _odom(stream: RobotStream, tick: int) -> Odometry:
    """Wheel odometry with the covariance of its yaw, and of the yaw rate in the last 0.2 s."""
    odom = Odometry(child_frame_id="base_link")
    odom.header.frame_id = "odom"
    half = float(stream.wheels[tick]) / 2
    odom.pose.pose.orientation.z, odom.pose.pose.orientation.w = math.sin(half), math.cos(half)
    odom.pose.covariance[35] = float(stream.spread[tick]) + ROUGH**2
    before = max(tick - EVERY, 0)
    seconds = (tick - before) * PERIOD or PERIOD
    odom.twist.twist.linear.x = float(stream.speeds[tick])
    odom.twist.twist.angular.z = float(stream.wheels[tick] - stream.wheels[before]) / seconds
    odom.twist.covariance[35] = (float(stream.spread[tick] - stream.spread[before]) + ROUGH**2) / seconds**2
    return odom


def _imu(stream: RobotStream, tick: int) -> Imu:
    imu = Imu()
    imu.header.frame_id = "base_link"
    imu.orientation_covariance[0] = -1.0  # this IMU has no orientation: sensor_msgs/Imu
    imu.angular_velocity.z = float(stream.gyro[tick])
    imu.angular_velocity_covariance[8] = NOISE**2
    imu.linear_acceleration_covariance[0] = -1.0
    return imu


def robots(seed: int) -> list[functools.partial[Robots]]:
    """The companions of a run."""
    return [functools.partial(Robots, seed)]
