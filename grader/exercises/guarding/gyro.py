"""A heading from a gyro that has a bias."""

import itertools
import math
from typing import Any

import numpy as np

from grader.checks import Missed, otherwise, publishes, series, subscribes
from grader.checks.motion import yaw_at
from grader.checks.no_data import no_data
from grader.companions.blind_drivers import LateStarter
from grader.exercise import Exercise, Scenario
from grader.geometry.angles import least_turn, turn_between
from grader.geometry.near import is_near
from grader.variants import Variants
from sim import Network
from sim.evidence import Recording, Seconds

Headings = list[tuple[Seconds, float]]  # degrees

RESTING = 20.0  # seconds: from here on the robot stands, and it stood before LEAVING
LEAVING = 3.0
ALONG, MOST = 5.0, 0.9  # degrees; of the headings: a message that is lost is missing for a moment
LEAST, EXPLAINED = 0.01, 0.5  # of the angle; of the points, where one factor explains all headings
SLOW = 0.1  # degrees/s: a drift that is none
ROUNDED = math.degrees(0.01)  # of a sum in rad that keeps two decimals

LOSSY = Network(loss=0.1, delay=0.02, jitter=0.004)  # s; too little for one message to overtake another

gyro = Exercise("gyro", "A gyro without drift", scenarios=[
    Scenario("lab", 28, 5, [LateStarter]),
    Scenario("lab", 28, 6, [LateStarter], network=LOSSY),
], variants=Variants({"topic": ("/heading", "/turned", "/angle")}, texts=("{topic}",)))


@gyro.check(3, lasts=True)
def sums_up(run: Recording) -> Headings:
    """The node subscribes to /imu/data, and publishes Float64 messages on /heading, from start to end."""
    subscribes(run, "/imu/data", "sensor_msgs/msg/Imu")
    sent = publishes(run, gyro.drawn.topic, "std_msgs/msg/Float64", at_least=50)
    pause = max(after.stamp - before.stamp for before, after in itertools.pairwise(sent))
    if pause > 1.0 or sent[0].stamp > LEAVING or sent[-1].stamp < run.ended.stamp - 1.0:
        saw = f"messages from {sent[0].stamp:.3g} s to {sent[-1].stamp:.3g} s, with a pause of {pause:.3g} s"
        hint = "Publish in every callback. Until the bias is known, the heading is 0.0."
        raise Missed("a heading all the time, starting by 3 s at the latest", saw, hint)
    return series(run, gyro.drawn.topic, "data")


def _largest(headings: Headings) -> float:
    return max(abs(value) for _, value in headings)


def _ratio(run: Recording, headings: Headings) -> float:
    """The last heading divided by the angle that the robot turned; NaN where it turned too little."""
    steps = (after.yaw - before.yaw for before, after in itertools.pairwise(run.path))
    turned = math.degrees(sum(math.remainder(step, math.tau) for step in steps))
    return math.nan if abs(turned) < 60.0 else headings[-1][1] / turned


def _begins_late(run: Recording, headings: Headings) -> Any:
    begin = next((stamp for stamp, value in headings if value != 0.0), 0.0)
    return begin > LEAVING + 0.1 and {"begin": begin, "leaving": LEAVING}


def _at_rest(headings: Headings) -> Headings:
    return [(stamp, value) for stamp, value in headings if stamp >= RESTING]


def _drift(headings: Headings) -> float:
    """Return how fast the heading changes at the end, while the robot stands still (degrees/s)."""
    (first, before), (last, after) = _at_rest(headings)[0], _at_rest(headings)[-1]
    return (after - before) / (last - first)


def _drifts_by_the_bias(run: Recording, headings: Headings) -> Any:
    rates = series(run.during(0.0, 2.0), "/imu/data", "angular_velocity.z")
    bias = math.degrees(sum(rate for _, rate in rates) / len(rates)) if rates else 0.0
    drift = _drift(headings)
    return bias and 50.0 < abs(drift / bias) < 200.0 and {"times": abs(drift / bias)}


def _misses_steps(run: Recording, headings: Headings) -> Any:
    """Return whether a heading without drift is short by the share of messages lost on the network."""
    links = [one for one in run.crossings
             if one.topic == "/imu/data" and one.listener not in run.course_nodes and one.sent]
    lost = max((one.lost / one.sent for one in links), default=0.0)
    is_short = abs(_ratio(run, headings) - (1.0 - lost)) < lost / 2
    return lost and is_short and abs(_drift(headings)) < 0.1 and {"lost": lost}


@gyro.check(4, after=sums_up, hints={
    "It stays 0 all the time: collect the first 200 rates, and integrate the ones after them.":
        lambda run, headings: _largest(headings) == 0.0,
    "It stays near 0 all the time: add a step for each message, self.yaw += (rate - bias) * (now - before).":
        lambda run, headings: _largest(headings) < 2.0,
    "It is near 0 whenever the robot stands still: that is how fast it turns, not how far. Add up the steps.":
        lambda run, headings: abs(headings[-1][1]) < 2.0 and _largest(headings) > 30.0,
    "{value} is not a heading: did you divide by zero, or start a sum from something that isn't a number?":
        lambda run, headings: (bad := [value for _, value in headings if not math.isfinite(value)])
        and {"value": bad[0]},
    "The sign is wrong: a positive angular_velocity.z is a turn to the left, and so is the heading.":
        lambda run, headings: -1.2 < _ratio(run, headings) < -0.8,
    "That is the angle in radians: math.degrees(...) converts it to degrees.":
        lambda run, headings: 0.01 < _ratio(run, headings) < 0.025,
    "That is about 57 times too far, which is 180 / pi: keep self.yaw in radians, and call math.degrees(...) "
    "only once, when you publish.": lambda run, headings: 50.0 < _ratio(run, headings) < 65.0,
    "That is about {ratio:.0f} times too far. Each reading is a rate, in rad/s, and lasts for the seconds "
    "since the previous one: add rate * (now - self.before).":
        lambda run, headings: (ratio := _ratio(run, headings)) > 2.5 and {"ratio": ratio},
    "The heading begins at {begin:.3g} s, but the robot sets off at {leaving:g} s: your mean of the rates "
    "includes part of its turn. Take the mean over the first 2 s only.": _begins_late,
    "The heading settles on a multiple of {step:.2g} degrees, or 0.01 rad: do you round the sum at each "
    "step? That loses small steps. Round only what you print.":
        lambda run, headings: all(
            abs(math.remainder(value, ROUNDED)) < 0.02 for _, value in _at_rest(headings)
        ) and {"step": ROUNDED},
    "It drifts {times:.0f} times as fast as the gyro's bias. The bias is a rate, too, so multiply it by "
    "the time step as well: (rate - bias) * (now - self.before).": _drifts_by_the_bias,
    "It falls short by as much as was lost: {lost:.0%} of the messages never arrived. After a lost message "
    "the step is longer than 0.01 s, so use the difference of the two stamps, now - self.before.":
        _misses_steps,
    "That is the gyro's bias: it reports a turn where there is none, and the error grows. Take the mean of "
    "angular_velocity.z over the first 2 s, while the robot stands still, and subtract it from every later "
    "reading.": otherwise,
})
def ends_right(run: Recording, headings: Headings) -> Headings:
    """At the end the heading is how far the robot has turned since the start, within 3 degrees."""
    stamp, value = headings[-1]
    turned = _turned(run, stamp)
    if not is_near(turn_between(value, turned), 0.0, 3.0):
        expected, saw = f"{turned:.1f} degrees at {stamp:.3g} s", f"{value:.4g} degrees"
        scaled = _scaled(run, headings)
        credit = EXPLAINED if scaled else 0.0
        topic = gyro.drawn.topic
        raise Missed(expected, saw, picture=topic, about=(headings,), credit=credit, measured=scaled)
    return headings


def _scaled(run: Recording, headings: Headings) -> Headings:
    """The headings in the right unit, where one factor explains them all; none otherwise.

    So the turn is added up without the bias, and the rest can be judged.
    """
    stamps, values = np.array(headings).T
    yaws = np.degrees(np.unwrap([pose.yaw for pose in run.path]))
    turned = np.interp(stamps, [pose.stamp for pose in run.path], yaws) - yaws[0]
    parts = np.column_stack([turned, stamps, np.ones_like(stamps)])
    if not np.isfinite(values).all():
        return []
    for whole in (values, np.unwrap(values, period=360.0), np.unwrap(values, period=math.tau)):
        (factor, drift, start), *_ = np.linalg.lstsq(parts, whole, rcond=None)
        off = np.quantile(np.abs(whole - parts @ (factor, drift, start)), MOST)
        size = abs(factor)
        if LEAST < size < math.inf and abs(drift) < SLOW * size and off < ALONG * size:
            return list(zip(stamps.tolist(), (whole / factor).tolist(), strict=True))
    return []


@gyro.check(5, after=ends_right)
def does_not_drift(run: Recording, headings: Headings) -> None:
    """At the end the robot stands still for 8 s, and so does the heading: it changes by under a degree."""
    resting = _at_rest(headings)
    if len(resting) < 2:
        raise no_data(run, f"headings from {RESTING:g} s on", f"{len(resting)}", [])
    (first, before), (last, after) = resting[0], resting[-1]
    drift = turn_between(after, before)
    if not is_near(drift, 0.0, 1.0):
        expected = (f"less than 1 degree of change from {first:.3g} s to {last:.3g} s, while the robot "
                    "stands still")
        saw = f"{drift:.3g} degrees, which is {drift / (last - first):.3g} degrees a second"
        hint = "It reaches the right heading too late: publish the sum itself, without smoothing."
        raise Missed(expected, saw, hint, picture=gyro.drawn.topic)


@gyro.check(3, after=ends_right)
def is_right_all_the_time(run: Recording, headings: Headings) -> None:
    """It is also right along the way, within 5 degrees."""
    if headings != series(run, gyro.drawn.topic, "data"):
        return  # one factor explains them
    for stamp, value in headings:
        if least_turn(value, [_turned(run, stamp - lag) for lag in (0.0, 0.05, 0.1)]) >= ALONG:
            hint = ("A heading is the sum of rate times time step: add one step for each reading, as it "
                    "arrives.")
            raise Missed(f"{_turned(run, stamp):.1f} degrees at {stamp:.3g} s", f"{value:.4g} degrees", hint)


def _turned(run: Recording, stamp: Seconds) -> float:
    """Return how far the robot has turned since the start, degrees to the left, in -180..180."""
    return turn_between(yaw_at(run, stamp), math.degrees(run.path[0].yaw))
