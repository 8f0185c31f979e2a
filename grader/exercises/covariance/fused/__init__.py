"""Wheels and a gyro, fused by a Kalman filter that learns the gyro's bias."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes
from grader.checks.no_data import no_data
from grader.exercise import Exercise, Scenario
from grader.exercises.covariance.fused.fair_seeds import FAIR
from grader.exercises.covariance.fused.robot_streams import PERIOD, SECONDS, STEPS, STREAMS, robots, streams
from grader.exercises.covariance.fused.tracks import (
    BETTER,
    Track,
    bad_group,
    gyro_error,
    rms,
    silent,
    wheels_error,
)
from grader.variants import Variants
from sim.evidence import Recording, Seconds, since_start

PAUSE = 0.75  # s between the stamps of two estimates
WARM = 1.0  # s from a drive's start in which no estimate is due
BOUNDS = 12.401 / STREAMS, 39.364 / STREAMS  # 95 % of the sets of 24 honest estimates are between these
SCORE = -1.1  # the mean log score that an honest and useful estimate stays below, measured
HUGE = 0.1  # a mean squared error in units of the variance below this is next to nothing
VARIES = 2.0  # the largest of the 24 variances over the smallest is above this; the right designs have 9
DEGREES = math.degrees(1.0) ** 2

fused = Exercise("fused", "Wheels and gyro, fused", scenarios=[
    Scenario(seconds=SECONDS, seed=FAIR[0], companions=robots, fair=FAIR),
], variants=Variants(
    {"topic": ("/odometry/filtered", "/odometry/fused", "/odometry/gyro")},
    texts=("{topic}",),
))  # fmt: skip

__all__ = ["fused", "robots"]


@fused.check(2, lasts=True)
def publishes_estimates(run: Recording) -> list[Track]:
    """The node fuses /odom and /imu/data, and publishes Odometry on /odometry/filtered in each drive."""
    subscribes(run, "/odom", "nav_msgs/msg/Odometry")
    subscribes(run, "/imu/data", "sensor_msgs/msg/Imu")
    sent = publishes(run, fused.drawn.topic, "nav_msgs/msg/Odometry", at_least=STREAMS)
    firsts = _starts(run)
    rows = np.array([_row(each.message) for each in sent])
    tracks = []
    for number, (begin, stream) in enumerate(zip(firsts, streams(run.seed), strict=False), 1):
        inside = (rows[:, 0] >= begin - PERIOD) & (rows[:, 0] <= begin + (STEPS + 2) * PERIOD)
        stamps, yaws, variances = rows[inside].T
        track = Track(stream, begin, stamps - begin, yaws, variances)
        if track.at(STEPS) is None or stamps[0] - begin > WARM:
            spans = f"from {stamps[0]:.4g} s to {stamps[-1]:.4g} s" if len(stamps) else "none"
            hint = ("header.stamp is the time for which the estimate holds: that of the newest measurement "
                    "in it. Publish one after each measurement that you have processed.")
            end = begin + STEPS * PERIOD
            raise Missed(f"estimates with stamps from {begin:.4g} s to {end:.4g} s in drive {number}",
                         spans, hint, picture="topics")
        tracks.append(track)
    if len(tracks) < STREAMS:
        raise no_data(run, f"{STREAMS} drives", f"{len(tracks)}", run.graph.publishers("/imu/data"))
    return tracks


def _starts(run: Recording) -> list[Seconds]:
    """The time of the first measurement of each drive."""
    resets = [row.stamp for row in run.messages("/reset_odometry")]
    stamps = sorted(since_start(row.message.header.stamp) for row in run.messages("/imu/data"))
    found = (next((stamp for stamp in stamps if stamp > reset), None) for reset in resets)
    return [stamp for stamp in found if stamp is not None]


def _row(odom: Any) -> tuple[float, float, float]:
    turn = odom.pose.pose.orientation
    return since_start(odom.header.stamp), 2 * math.atan2(turn.z, turn.w), odom.pose.covariance[35]


@fused.check(2, after=publishes_estimates)
def goes_on(run: Recording, tracks: list[Track]) -> None:
    """While one sensor is silent for up to 2 s, the estimates continue with the other."""
    for number, track in enumerate(tracks, 1):
        stamps = np.maximum(track.stamps, 0.0)  # a drive lasts longer than PAUSE, so there are two or more
        pauses = np.diff(stamps)
        longest = int(np.argmax(pauses))
        if not pauses[longest] <= PAUSE:
            pause, since = pauses[longest], track.begin + stamps[longest]
            hint = (f"In this drive the {'gyro is' if track.stream.silent == 'gyro' else 'wheels are'} "
                    "silent for a while. Process whatever has arrived from the other sensor, and publish.")
            saw = f"none for {pause:.3g} s, after {since:.4g} s, in drive {number}"
            raise Missed(f"estimates whose stamps are at most {PAUSE:g} s apart", saw, hint, picture="topics")


@fused.check(4, after=publishes_estimates, hints={
    "{value} is no number: did you divide by a time step of 0, or invert a variance of 0?":
        lambda run, tracks: (bad := [yaw for each in tracks for yaw in each.yaws if not math.isfinite(yaw)])
        and {"value": bad[0]},
    "That is what the wheels alone give: the gyro has next to no influence.":
        lambda run, tracks: rms([track.error() - wheels_error(track) for track in tracks]) < 0.09,
    "That is what the gyro alone gives: its bias stays in. Let the wheels correct it: where the gyro reports "
    "a turn and the wheels don't, the difference is bias.":
        lambda run, tracks: rms([math.remainder(track.error() - gyro_error(track), math.tau)
                                  for track in silent(tracks, "")]) < 0.03,
    "The drives in which the yaw passes pi are far worse than the others: wrap the innovation, "
    "math.remainder(z - predicted, math.tau).":
        lambda run, tracks: bad_group(tracks) == "pi",
    "The drives that begin in a turn are far worse than the others: a mean of the first readings is the bias "
    "only if the robot stands still. The filter learns it from the difference to the wheels.":
        lambda run, tracks: bad_group(tracks) == "turn",
    "The drives in which the gyro is silent are far worse than the others. Without the gyro the yaw is "
    "unknown: predict up to each message of the wheels as well, and let the yaw's variance "
    "grow by (1 rad/s * dt)**2.":
        lambda run, tracks: bad_group(tracks) == "gyro",
    "It is worse than the better sensor alone, so something is added up wrongly. Is each dt the difference "
    "of two header stamps, and are the measurements processed in the order of their stamps?": otherwise,
})
def beats_both(run: Recording, tracks: list[Track]) -> list[Track]:
    """At the end of the drives the yaw is clearly better than from the wheels or the gyro alone."""
    own = rms([track.error() for track in tracks])
    wheels, gyro = (rms([alone(track) for track in tracks]) for alone in (wheels_error, gyro_error))
    if not own <= BETTER * min(wheels, gyro):
        expected = f"an error of {BETTER * min(wheels, gyro):.3f} rad or less (RMS of {STREAMS} drives)"
        saw = f"{own:.3f} rad; the wheels alone have {wheels:.3f}, and the gyro alone {gyro:.3f}"
        raise Missed(expected, saw, about=(tracks,))
    return tracks


def _nees(tracks: list[Track]) -> float:
    """The mean squared error in units of the variance; inf if one is 0 or no number."""
    if not all(0.0 < track.variance() < math.inf for track in tracks):
        return math.inf
    return float(np.mean([track.error() ** 2 / track.variance() for track in tracks]))


@fused.check(3, after=beats_both, hints={
    "A variance of {value} is none. It is number 35 of pose.covariance; 0 would claim that the yaw "
    "is certain.":
        lambda run, tracks: (bad := [track.variance() for track in tracks
                                     if not 0.0 < track.variance() < math.inf]) and {"value": bad[0]},
    "That is in degrees: the variance of an angle is in rad².":
        lambda run, tracks: 0.3 / DEGREES < _nees(tracks) < 3 / DEGREES,
    "That covers every error, so it says nothing. Publish the variance that the filter calculates: P[0, 0].":
        lambda run, tracks: _nees(tracks) < HUGE,
    "The errors are larger than the variance says. Is the noise of the gyro in P (noise**2 * dt**2 for each "
    "reading), the wheels' slip, and the bias, which is not known at first (0.03**2)?":
        lambda run, tracks: _nees(tracks) > 1.0,
    "The errors are smaller than the variance says: some noise is in P twice, or its standard deviation "
    "isn't squared.": otherwise,
})
def is_consistent(run: Recording, tracks: list[Track]) -> list[Track]:
    """The errors are as large as the variance of the yaw says (NEES within its 95 % bounds)."""
    found = _nees(tracks)
    if not BOUNDS[0] <= found <= BOUNDS[1]:
        low, high = BOUNDS
        expected = f"a mean squared error of {low:.2f} to {high:.2f} in units of pose.covariance[35]"
        raise Missed(expected, f"{found:.3g}", about=(tracks,))
    return tracks


@fused.check(3, after=is_consistent)
def is_sharp(run: Recording, tracks: list[Track]) -> None:
    """The estimates say as much as can be said (the mean log score is good)."""
    sizes = [math.log(math.tau * track.variance()) / 2 for track in tracks]
    own = float(np.mean(sizes)) + _nees(tracks) / 2
    if not own <= SCORE:
        hint = ("The variance is honest, but larger than it has to be: publish the filter's own yaw and "
                "P[0, 0] after each measurement. After a drive with rests it is much smaller than after one "
                "with gaps.")
        expected = f"-log of the density at the true yaw: {SCORE:g} or less, on average"
        raise Missed(expected, f"{own:.3f}", hint)
    variances = [track.variance() for track in tracks]
    if not max(variances) >= VARIES * min(variances):
        hint = ("One number fits no drive: after one with rests the yaw is known much better than after one "
                "in which the gyro was silent. Publish the variance that the filter calculates: P[0, 0].")
        expected = f"variances that differ by a factor of {VARIES:g} or more"
        saw = f"{min(variances):.3g} to {max(variances):.3g} after all {STREAMS} drives"
        raise Missed(expected, saw, hint)
