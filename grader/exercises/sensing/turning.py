"""Exercises on directions: a heading from odometry, and one from a gyro that has a bias."""

from __future__ import annotations

import bisect
import itertools
import math

from grader.checks import Missed, check, publishes, series, subscribes
from grader.exercise import Exercise
from grader.exercises.sensing.partners import Circling, LateStarter
from sim.recording import Recording, Seconds

FLOAT64 = "std_msgs/msg/Float64"
HEADING = "/heading"
LAG = 0.15  # seconds: what a node says may be so old
NEAR = 1.0  # degrees


@check(points=2)
def says_a_heading(recording: Recording) -> None:
    """The node hears /odom, and publishes Float64 messages on /heading."""
    subscribes(recording, "/odom", "nav_msgs/msg/Odometry")
    publishes(recording, HEADING, FLOAT64, at_least=20)


@check(points=4, after=says_a_heading)
def heading_is_right(recording: Recording) -> None:
    """It is the robot's yaw in degrees: 0 along x, 90 to the left, -90 to the right."""
    said = series(recording, HEADING, "data")
    stamp, worst = max(said, key=lambda pair: _error(recording, *pair))
    if _error(recording, stamp, worst) > NEAR:
        yaw = _yaw(recording, stamp)
        raise Missed(f"{yaw:.1f} degrees at {stamp:.3g} s", f"{worst:.4g}", _why_not(worst, yaw))


@check(points=2, after=heading_is_right)
def heading_is_in_range(recording: Recording) -> None:
    """It is always from -180 to 180 degrees."""
    for stamp, said in series(recording, HEADING, "data"):
        if not abs(said) <= 180.0 + 1e-6:
            raise Missed(
                "degrees from -180 to 180",
                f"{said:.4g} at {stamp:.3g} s",
                "math.atan2 gives an angle in this range. Don't add 360, and don't use % 360 alone.",
            )


def _yaw(recording: Recording, stamp: Seconds) -> float:
    """The robot's true yaw at a moment, degrees."""
    index = bisect.bisect_right(recording.path, stamp + 1e-6, key=lambda pose: pose.stamp) - 1
    return math.degrees(recording.path[max(index, 0)].yaw)


def _error(recording: Recording, stamp: Seconds, said: float) -> float:
    """How far a heading is from the truth now or shortly before, degrees."""
    if not math.isfinite(said):
        return math.inf
    lags = (0.0, 0.05, 0.1, LAG)
    return min(abs(math.remainder(said - _yaw(recording, stamp - lag), 360.0)) for lag in lags)


def _why_not(said: float, yaw: float) -> str:
    """The usual reasons for a wrong heading; both in degrees."""
    radians = math.radians(yaw)
    half = math.sin(radians / 2)
    reasons = [
        (radians, "That is the angle in radians: math.degrees(...) turns it into degrees."),
        (half, "That is orientation.z. The numbers of a quaternion are no angles: yaw = 2 * atan2(z, w)."),
        (math.degrees(half), "orientation.z is the sine of half the angle: yaw = 2 * atan2(z, w)."),
        (yaw / 2, "That is half of it: a quaternion holds half the angle. yaw = 2 * atan2(z, w)."),
        (-yaw, "The sign is wrong: left is positive. acos(w) loses the side; use atan2(z, w)."),
        (math.degrees(math.sin(radians)), "That is the sine of the angle in place of the angle."),
    ]
    for value, hint in reasons:
        if abs(math.remainder(said - value, 360.0)) < 0.5:
            return hint
    return "With q = msg.pose.pose.orientation: yaw = 2 * math.atan2(q.z, q.w), then math.degrees(yaw)."


heading = Exercise(
    "heading",
    "A compass from odometry",
    [says_a_heading, heading_is_right, heading_is_in_range],
    world="yard",
    seconds=20,
    companions=[Circling],
    seeds=(1, 2),
)


RESTING = 20.0  # seconds: from here on the robot stands, and it stood before LEAVING
LEAVING = 3.0
BIAS = (
    "That is the gyro's bias: it says a turn where there is none, and the error grows. Take the mean of "
    "angular_velocity.z over the first 2 s, when the robot stands, and subtract it from every reading "
    "after."
)


@check(points=3)
def sums_up(recording: Recording) -> None:
    """The node hears /imu/data, and publishes Float64 messages on /heading, from start to end."""
    subscribes(recording, "/imu/data", "sensor_msgs/msg/Imu")
    heard = publishes(recording, HEADING, FLOAT64, at_least=50)
    pause = max(after.stamp - before.stamp for before, after in itertools.pairwise(heard))
    if pause > 1.0 or heard[0].stamp > LEAVING or heard[-1].stamp < recording.ended.stamp - 1.0:
        raise Missed(
            "a heading all the time, from 3 s on at the latest",
            f"messages from {heard[0].stamp:.3g} s to {heard[-1].stamp:.3g} s, with a pause of {pause:.3g} s",
            "Publish in every callback. Before the bias is known, the heading is 0.0.",
        )


@check(points=5, after=sums_up)
def does_not_drift(recording: Recording) -> None:
    """At the end the robot stands for 8 s, and the heading stands, too: it changes by less than 1 degree."""
    resting = [(stamp, said) for stamp, said in series(recording, HEADING, "data") if stamp >= RESTING]
    (first, before), (last, after) = resting[0], resting[-1]
    drift = math.remainder(after - before, 360.0)
    if not abs(drift) < 1.0:
        raise Missed(
            f"less than 1 degree of change from {first:.3g} s to {last:.3g} s, while the robot stands",
            f"{drift:.3g} degrees, which is {drift / (last - first):.3g} degrees a second",
            _wrong_scale(recording) or BIAS,
            picture="topics",
        )


@check(points=4, after=sums_up)
def ends_right(recording: Recording) -> None:
    """At the end the heading is how far the robot has turned since the start, within 3 degrees."""
    stamp, said = series(recording, HEADING, "data")[-1]
    turned = _turned(recording, stamp)
    if not abs(math.remainder(said - turned, 360.0)) < 3.0:
        raise Missed(
            f"{turned:.1f} degrees at {stamp:.3g} s",
            f"{said:.4g} degrees",
            _why_not_turned(recording, said),
            picture="topics",
        )


@check(points=3, after=ends_right)
def is_right_all_the_time(recording: Recording) -> None:
    """It is right on the way, too, within 5 degrees."""
    for stamp, said in series(recording, HEADING, "data"):
        errors = (
            abs(math.remainder(said - _turned(recording, stamp - lag), 360.0)) for lag in (0.0, 0.05, 0.1)
        )
        if not min(errors) < 5.0:
            raise Missed(
                f"{_turned(recording, stamp):.1f} degrees at {stamp:.3g} s",
                f"{said:.4g} degrees",
                "A heading is the sum of rate times time step, with each reading as it comes.",
            )


def _turned(recording: Recording, stamp: Seconds) -> float:
    """How far the robot has turned since the start, degrees to the left, in -180..180."""
    return math.remainder(_yaw(recording, stamp) - math.degrees(recording.path[0].yaw), 360.0)


def _why_not_turned(recording: Recording, said: float) -> str:
    """The usual reasons for a wrong sum."""
    largest = max(abs(value) for _, value in series(recording, HEADING, "data"))
    if largest == 0.0:
        return "It stays 0 all the time: collect the first 200 rates, and add up from then on."
    if largest < 2.0:
        return "It stays near 0 all the time: each message adds its step, self.yaw += (rate - bias) * 0.01."
    if abs(said) < 2.0 and largest > 30.0:
        return "It is near 0 when the robot stands: that says how fast it turns, not how far. Add up."
    return _wrong_scale(recording) or BIAS


def _wrong_scale(recording: Recording) -> str:
    """Where the sum is a multiple of the turn: what is wrong with it, most likely."""
    _, said = series(recording, HEADING, "data")[-1]
    steps = (after.yaw - before.yaw for before, after in itertools.pairwise(recording.path))
    turned = math.degrees(sum(math.remainder(step, math.tau) for step in steps))
    if abs(turned) < 60.0:
        return ""
    ratio = said / turned
    if -1.2 < ratio < -0.8:
        return (
            "The sign is wrong: a positive angular_velocity.z is a turn to the left, and so is the heading."
        )
    if 0.01 < ratio < 0.025:
        return "That is the angle in radians: math.degrees(...) turns it into degrees."
    if 50.0 < ratio < 65.0:
        return (
            "That is some 57 times too far, which is 180 / pi: self.yaw is in radians, and math.degrees(...) "
            "comes only once, where it is published."
        )
    if ratio > 2.5:
        return (
            f"That is some {ratio:.0f} times too far. Each reading is a rate, in rad/s, and counts for the "
            "time since the last one, 0.01 s: add rate * 0.01."
        )
    return ""


gyro = Exercise(
    "gyro",
    "A gyro without drift",
    [sums_up, does_not_drift, ends_right, is_right_all_the_time],
    world="lab",
    seconds=28,
    companions=[LateStarter],
    seeds=(5, 6),
)
