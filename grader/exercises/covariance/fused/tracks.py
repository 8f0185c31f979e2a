"""A student's estimates for each drive, their errors, and the drives that explain a large error."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grader.exercises.covariance.fused.robot_streams import PERIOD, STEPS, RobotStream
from sim.evidence import Seconds

NEAR = 0.25  # s between the end, where the robot stands still, and the stamp of an estimate
BETTER = 0.75  # the error over that of the better sensor alone
FAR = 0.3  # rad: an error (RMS) that no noise explains
TINY = 1e-6  # rad


class Track(NamedTuple):
    """The estimates for one drive: seconds since its start, yaws (rad), and their variances (rad²)."""

    stream: RobotStream
    begin: Seconds
    stamps: np.ndarray
    yaws: np.ndarray
    variances: np.ndarray

    def at(self, tick: int) -> int | None:
        """The index of the last estimate for a tick; None if there is none."""
        if not len(self.stamps):
            return None
        index = len(self.stamps) - 1 - int(np.argmin(np.abs(self.stamps - tick * PERIOD)[::-1]))
        return index if abs(self.stamps[index] - tick * PERIOD) <= NEAR else None

    def error(self, tick: int = STEPS) -> float:
        """The error of the yaw (rad) at a tick at which there is an estimate; NaN for no number."""
        off = self.yaws[self.at(tick)] - self.stream.yaws[tick]
        return math.remainder(off, math.tau) if math.isfinite(off) else math.nan

    def variance(self, tick: int = STEPS) -> float:
        """The variance at a tick at which there is an estimate."""
        return float(self.variances[self.at(tick)])


def rms(errors: list[float]) -> float:
    """The root of the mean square of errors (rad)."""
    return math.sqrt(float(np.mean(np.square(errors))))


def wheels_error(track: Track) -> float:
    """The error (rad) that the wheels' yaw alone has at the end of a drive."""
    return math.remainder(track.stream.wheels[STEPS] - track.stream.yaws[STEPS], math.tau)


def gyro_error(track: Track) -> float:
    """The error (rad) that the gyro's rates alone, added up, have at the end of a drive."""
    return float(track.stream.gyro[1 : STEPS + 1].sum()) * PERIOD - float(track.stream.yaws[STEPS])


def silent(tracks: list[Track], sensor: str) -> list[Track]:
    """The drives in which a sensor is silent for a while: gyro, wheels or "" for neither."""
    return [track for track in tracks if track.stream.silent == sensor]


def _in_a_turn(tracks: list[Track]) -> list[Track]:
    return [track for track in tracks if track.stream.speeds[0] > 0.1]


def _jumps(track: Track) -> bool:
    """Return whether the wheels' yaw passes from pi to -pi in this drive."""
    return not np.abs(track.stream.wheels[: STEPS + 1]).max() <= math.pi


def bad_group(tracks: list[Track]) -> str:
    """The drives that explain a large error, because it is small in all others: turn, gyro, pi or ""."""
    groups = {
        "turn": _in_a_turn(tracks),
        "gyro": silent(tracks, "gyro"),
        "pi": [track for track in tracks if _jumps(track)],
    }
    limit, found = BETTER * rms([wheels_error(track) for track in tracks]), {"": 0.0}
    for name, chosen in groups.items():
        rest = [track for track in tracks if not any(track is one for one in chosen)]
        if not chosen or not rest:
            continue
        good, bad = (rms([track.error() for track in part]) for part in (rest, chosen))
        if good < limit and bad > FAR:
            found[name] = bad / max(good, TINY)
    return max(found, key=lambda name: found[name])
