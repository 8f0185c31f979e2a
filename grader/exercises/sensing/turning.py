"""Exercises on directions: a heading from odometry, and one from a gyro that has a bias."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Callable

from grader.checks import Missed, lasts, publishes, series, subscribes, usual_mistake
from grader.checks.no_data import no_data
from grader.companions.blind_drivers import Circling, LateStarter
from grader.exercise import Exercise
from sim.evidence import Recording, Seconds

FLOAT64 = "std_msgs/msg/Float64"
HEADING = "/heading"
NEAR = 1.0  # degrees

LogMatch = list[tuple[Seconds, float]]  # headings with their stamps, degrees

heading = Exercise(
    "heading", "A compass from odometry", world="yard", seconds=20, companions=[Circling], seeds=(1, 2)
)


@heading.check(2)
def says_a_heading(run: Recording) -> LogMatch:
    """The node hears /odom, and publishes Float64 messages on /heading."""
    subscribes(run, "/odom", "nav_msgs/msg/Odometry")
    publishes(run, HEADING, FLOAT64, at_least=20)
    return series(run, HEADING, "data")


@heading.check(4, after=says_a_heading)
def heading_is_right(run: Recording, headings: LogMatch) -> LogMatch:
    """It is the robot's yaw in degrees: 0 along x, 90 to the left, -90 to the right."""

    def error(stamp: Seconds, said: float) -> float:
        return _least_error(said, [_yaw(run, stamp - lag) for lag in (0.0, 0.05, 0.1, 0.15)])

    stamp, worst = max(headings, key=lambda pair: error(*pair))
    if error(stamp, worst) > NEAR:
        yaw = _yaw(run, stamp)
        hint = usual_mistake(_MISTAKES, lambda formula: abs(_turn(worst, formula(math.radians(yaw)))) < 0.5)
        guess = "With q = msg.pose.pose.orientation: yaw = 2 * math.atan2(q.z, q.w), then math.degrees(yaw)."
        raise Missed(f"{yaw:.1f} degrees at {stamp:.3g} s", f"{worst:.4g}", hint or guess)
    lasts(run, HEADING)
    return headings


_MISTAKES: dict[str, Callable[[float], float]] = {  # what a node says in place of a yaw in rad
    "That is the angle in radians: math.degrees(...) turns it into degrees.": lambda yaw: yaw,
    "That is orientation.z. The numbers of a quaternion are not angles: yaw = 2 * atan2(z, w).": (
        lambda yaw: math.sin(yaw / 2)
    ),
    "orientation.z is the sine of half the angle: yaw = 2 * atan2(z, w).": (
        lambda yaw: math.degrees(math.sin(yaw / 2))
    ),
    "That is half of it: a quaternion holds half the angle. yaw = 2 * atan2(z, w).": (
        lambda yaw: math.degrees(yaw / 2)
    ),
    "The sign is wrong: left is positive. acos(w) loses the side; use atan2(z, w).": (
        lambda yaw: math.degrees(-yaw)
    ),
    "That is the sine of the angle, not the angle.": lambda yaw: math.degrees(math.sin(yaw)),
}


@heading.check(2, after=heading_is_right)
def heading_is_in_range(run: Recording, headings: LogMatch) -> None:
    """It is always from -180 to 180 degrees."""
    for stamp, said in headings:
        if not abs(said) <= 180.0 + 1e-6:
            raise Missed(
                "degrees from -180 to 180",
                f"{said:.4g} at {stamp:.3g} s",
                "math.atan2 gives an angle in this range. Don't add 360, and don't use % 360 alone.",
            )


def _yaw(run: Recording, stamp: Seconds) -> float:
    """The robot's true yaw at a moment, degrees: of its last pose until then, the one a node could know."""
    index = bisect.bisect_right(run.path, stamp + 1e-6, key=lambda pose: pose.stamp) - 1
    return math.degrees(run.path[max(index, 0)].yaw)


def _turn(one: float, other: float) -> float:
    """By how much one direction lies to the left of another, degrees from -180 to 180; inf for no number."""
    return math.remainder(one - other, 360.0) if math.isfinite(one - other) else math.inf


def _least_error(said: float, yaws: list[float]) -> float:
    """How far a heading is from the nearest of these, degrees."""
    return min(abs(_turn(said, yaw)) for yaw in yaws)


RESTING = 20.0  # seconds: from here on the robot stands, and it stood before LEAVING
LEAVING = 3.0
ROUNDED = math.degrees(0.01)  # of a sum in rad that keeps two decimals
BIAS = (
    "That is the gyro's bias: it reports a turn where there is none, and the error grows. Take the mean of "
    "angular_velocity.z over the first 2 s, when the robot stands, and subtract it from every reading "
    "after."
)

gyro = Exercise(
    "gyro", "A gyro without drift", world="lab", seconds=28, companions=[LateStarter], seeds=(5, 6)
)


@gyro.check(3, lasts=True)
def sums_up(run: Recording) -> LogMatch:
    """The node hears /imu/data, and publishes Float64 messages on /heading, from start to end."""
    subscribes(run, "/imu/data", "sensor_msgs/msg/Imu")
    heard = publishes(run, HEADING, FLOAT64, at_least=50)
    pause = max(after.stamp - before.stamp for before, after in itertools.pairwise(heard))
    if pause > 1.0 or heard[0].stamp > LEAVING or heard[-1].stamp < run.ended.stamp - 1.0:
        raise Missed(
            "a heading all the time, from 3 s on at the latest",
            f"messages from {heard[0].stamp:.3g} s to {heard[-1].stamp:.3g} s, with a pause of {pause:.3g} s",
            "Publish in every callback. Before the bias is known, the heading is 0.0.",
        )
    return series(run, HEADING, "data")


@gyro.check(4, after=sums_up)
def ends_right(run: Recording, headings: LogMatch) -> LogMatch:
    """At the end the heading is how far the robot has turned since the start, within 3 degrees."""
    stamp, said = headings[-1]
    turned = _turned(run, stamp)
    if abs(_turn(said, turned)) >= 3.0:
        raise Missed(
            f"{turned:.1f} degrees at {stamp:.3g} s",
            f"{said:.4g} degrees",
            _why_not_turned(run, headings),
            credit=0.5 if _is_in_other_units(said, turned) else 0.0,
            picture="topics",
            measured=headings,
        )
    return headings


def _is_in_other_units(said: float, turned: float) -> bool:
    """Whether a heading is right but for its sign or its unit: somebody did add up the turn."""
    if not math.isfinite(said):
        return False
    radians = abs(math.remainder(said - math.radians(turned), math.tau)) < math.radians(3.0)
    return abs(_turn(-said, turned)) < 3.0 or (radians and abs(turned) > 20.0)


@gyro.check(5, after=ends_right)
def does_not_drift(run: Recording, headings: LogMatch) -> None:
    """At the end the robot stands for 8 s, and the heading stands, too: it changes by less than 1 degree."""
    resting = [(stamp, said) for stamp, said in headings if stamp >= RESTING]
    if len(resting) < 2:
        raise no_data(run, f"headings from {RESTING:g} s on", f"{len(resting)}", [])
    (first, before), (last, after) = resting[0], resting[-1]
    drift = _turn(after, before)
    if abs(drift) >= 1.0:
        raise Missed(
            f"less than 1 degree of change from {first:.3g} s to {last:.3g} s, while the robot stands",
            f"{drift:.3g} degrees, which is {drift / (last - first):.3g} degrees a second",
            "It comes to the right heading too late: publish the sum as it is, without smoothing.",
            picture="topics",
        )


@gyro.check(3, after=ends_right)
def is_right_all_the_time(run: Recording, headings: LogMatch) -> None:
    """It is right on the way, too, within 5 degrees."""
    for stamp, said in headings:
        if _least_error(said, [_turned(run, stamp - lag) for lag in (0.0, 0.05, 0.1)]) >= 5.0:
            raise Missed(
                f"{_turned(run, stamp):.1f} degrees at {stamp:.3g} s",
                f"{said:.4g} degrees",
                "A heading is the sum of rate times time step, with each reading as it comes.",
            )


def _turned(run: Recording, stamp: Seconds) -> float:
    """How far the robot has turned since the start, degrees to the left, in -180..180."""
    return _turn(_yaw(run, stamp), math.degrees(run.path[0].yaw))


def _why_not_turned(run: Recording, headings: LogMatch) -> str:
    """The usual reasons for a wrong sum."""
    largest = max(abs(said) for _, said in headings)
    if largest == 0.0:
        return "It stays 0 all the time: collect the first 200 rates, and add up from then on."
    if largest < 2.0:
        return "It stays near 0 all the time: each message adds its step, self.yaw += (rate - bias) * 0.01."
    if abs(headings[-1][1]) < 2.0 and largest > 30.0:
        return "It is near 0 when the robot stands: that says how fast it turns, not how far. Add up."
    return _wrong_sum(run, headings)


def _wrong_sum(run: Recording, headings: LogMatch) -> str:
    """Where something is added up, but not the turn: what is wrong with it, most likely."""
    strange = next((said for _, said in headings if not math.isfinite(said)), None)
    if strange is not None:
        return f"{strange} is not a heading: something was divided by zero, or a sum began with no number."
    return _wrong_scale(run, headings) or _wrong_bias(run, headings) or BIAS


def _wrong_bias(run: Recording, headings: LogMatch) -> str:
    """Where a bias was taken, but not as it should be: how."""
    begin = next((stamp for stamp, said in headings if said != 0.0), 0.0)
    if begin > LEAVING + 0.1:
        return (
            f"The heading begins at {begin:.3g} s, and the robot sets off at {LEAVING:g} s: the mean of the "
            "rates until then has its turn in it, too. Take the mean over the first 2 s only."
        )
    resting = [(stamp, said) for stamp, said in headings if stamp >= RESTING]
    if all(abs(math.remainder(said, ROUNDED)) < 0.02 for _, said in resting):
        return (
            f"The heading comes to rest on a multiple of {ROUNDED:.2g} degrees, or 0.01 rad: is the sum "
            "rounded at each step? Then small steps are lost. Round only what you print."
        )
    rates = series(run.during(0.0, 2.0), "/imu/data", "angular_velocity.z")
    bias = math.degrees(sum(rate for _, rate in rates) / len(rates)) if rates else 0.0
    drift = (resting[-1][1] - resting[0][1]) / (resting[-1][0] - resting[0][0])
    if bias and 50.0 < abs(drift / bias) < 200.0:
        return (
            f"It drifts {abs(drift / bias):.0f} times as fast as the gyro's bias. The bias is a rate, too, "
            "and counts for the 0.01 s since the last message, not for a whole second: (rate - bias) * 0.01."
        )
    return ""


def _wrong_scale(run: Recording, headings: LogMatch) -> str:
    """Where the sum is a multiple of the turn: what is wrong with it, most likely."""
    steps = (after.yaw - before.yaw for before, after in itertools.pairwise(run.path))
    turned = math.degrees(sum(math.remainder(step, math.tau) for step in steps))
    if abs(turned) < 60.0:
        return ""
    ratio = headings[-1][1] / turned
    mistakes = {
        "The sign is wrong: a positive angular_velocity.z is a turn to the left, and so is the heading.": (
            (-1.2, -0.8)
        ),
        "That is the angle in radians: math.degrees(...) turns it into degrees.": (0.01, 0.025),
        "That is some 57 times too far, which is 180 / pi: self.yaw is in radians, and math.degrees(...) "
        "comes only once, where it is published.": (50.0, 65.0),
        f"That is some {ratio:.0f} times too far. Each reading is a rate, in rad/s, and counts for the "
        "time since the last one, 0.01 s: add rate * 0.01.": (2.5, math.inf),
    }
    return usual_mistake(mistakes, lambda ratios: ratios[0] < ratio < ratios[1])
