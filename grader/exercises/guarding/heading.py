"""A compass from odometry."""

import math
from collections.abc import Callable

from grader.checks import Missed, lasts, otherwise, publishes, series, subscribes
from grader.checks.motion import yaw_at
from grader.companions.blind_drivers import Circling
from grader.exercise import Exercise
from grader.geometry.angles import least_turn, turn_between
from grader.variants import Variants
from sim.evidence import Recording, Seconds

Headings = list[tuple[Seconds, float]]  # degrees

NEAR = 1.0  # degrees
LAGS = 0.0, 0.05, 0.1, 0.15  # s for which a heading may be late
EXPLAINED = 0.5  # of the points, where one mistake explains all headings

heading = Exercise("heading", "A compass from odometry", world="yard", seconds=20, companions=[Circling],
                   seeds=(1, 2),
                   variants=Variants({"topic": ("/heading", "/compass", "/yaw")}, texts=("{topic}",)))


@heading.check(2)
def publishes_a_heading(run: Recording) -> Headings:
    """The node subscribes to /odom, and publishes Float64 messages on /heading."""
    subscribes(run, "/odom", "nav_msgs/msg/Odometry")
    topic = heading.drawn.topic
    publishes(run, topic, "std_msgs/msg/Float64", at_least=20)
    return series(run, topic, "data")


def _all_are(formula: Callable[[float], float]) -> Callable[..., bool]:
    """The cause of a miss: all wrong headings are what a wrong formula gives for a yaw in rad."""

    def explains(run: Recording, wrong: Headings) -> bool:
        return all(
            any(abs(turn_between(value, formula(math.radians(yaw)))) < 0.5 for yaw in _yaws(run, stamp))
            for stamp, value in wrong
        )

    return explains


def _yaws(run: Recording, stamp: Seconds) -> list[float]:
    return [yaw_at(run, stamp - lag) for lag in LAGS]


# Mistakes after which the rest can still be judged.
MISTAKES = {
    "That is the angle in radians: math.degrees(...) converts it to degrees.": _all_are(lambda yaw: yaw),
    "That is half of it: a quaternion contains half the angle. yaw = 2 * atan2(z, w).":
        _all_are(lambda yaw: math.degrees(yaw / 2)),
    "The sign is wrong: left is positive. acos(w) loses the sign; use atan2(z, w).":
        _all_are(lambda yaw: math.degrees(-yaw)),
    "The arguments are swapped: atan2(z, w), the sine first.":
        _all_are(lambda yaw: 180.0 - math.degrees(yaw)),
}


@heading.check(4, after=publishes_a_heading, hints=MISTAKES | {
    "That is orientation.z. The numbers in a quaternion aren't angles: yaw = 2 * atan2(z, w).":
        _all_are(lambda yaw: math.sin(yaw / 2)),
    "orientation.z is the sine of half the angle: yaw = 2 * atan2(z, w).":
        _all_are(lambda yaw: math.degrees(math.sin(yaw / 2))),
    "That is the sine of the angle, not the angle.": _all_are(lambda yaw: math.degrees(math.sin(yaw))),
    "With q = msg.pose.pose.orientation: yaw = 2 * math.atan2(q.z, q.w), then math.degrees(yaw).": otherwise,
})
def heading_is_right(run: Recording, headings: Headings) -> Headings:
    """It is the robot's yaw in degrees: 0 along x, 90 to the left, -90 to the right."""
    errors = [least_turn(value, _yaws(run, stamp)) for stamp, value in headings]
    if max(errors) > NEAR:
        wrong = [pair for pair, error in zip(headings, errors, strict=True) if error > NEAR]
        stamp, worst = headings[errors.index(max(errors))]
        explained = EXPLAINED * any(explains(run, wrong) for explains in MISTAKES.values())
        raise Missed(f"{yaw_at(run, stamp):.1f} degrees at {stamp:.3g} s", f"{worst:.4g}", about=(wrong,),
                     credit=explained, measured=headings)
    lasts(run, heading.drawn.topic)
    return headings


@heading.check(2, after=heading_is_right)
def heading_is_in_range(run: Recording, headings: Headings) -> None:
    """It is always between -180 and 180 degrees."""
    for stamp, value in headings:
        if not abs(value) <= 180.0 + 1e-6:
            hint = "math.atan2 gives an angle in this range. Don't add 360, and don't use % 360 alone."
            raise Missed("degrees from -180 to 180", f"{value:.4g} at {stamp:.3g} s", hint)
