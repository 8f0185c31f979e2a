"""Bags with one fault each, or none: its name, its amount, and the evidence."""

import functools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from grader.checks import Missed, publishes
from grader.companions.recorded_robots import BEGIN, END
from grader.exercise import Exercise, Scenario
from grader.exercises.bags.bag_faults.faulty_bags import BUSY, FAULTS, NONE, Case, draw_case, player_of
from grader.exercises.bags.bag_faults.practice_bags import faulty_bag
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Recording, Seconds, since_start
from sim.nanoseconds import EPOCH, SECOND

__all__ = ["bag_faults", "faulty_bag"]

TYPE = "diagnostic_msgs/msg/DiagnosticStatus"
NAMES = (*FAULTS, NONE)
KINDS = ("two_odometries", NONE, "wheel_radius", "missing_transform", BUSY, "lidar_yaw", "clock_offset")
SECONDS = END + 4.0
EXACT = {
    "wheel_radius": 0.02,
    "lidar_yaw": math.radians(2.0),
    "clock_offset": 0.03,
    "missing_transform": 0.3,
    "two_odometries": 0.06,
}
UNITS = {"wheel_radius": "", "lidar_yaw": " rad", "two_odometries": " m"}  # s otherwise
MOVING, NEAR, LATE = 0.08, 0.3, 0.1  # m/s or rad/s; s around a moment; s


def companions(kind: str, seed: int) -> Sequence[Any]:
    """The player of a bag of this kind."""
    return [player_of(draw_case(kind, seed))]


bag_faults = Exercise(
    "bag_faults",
    "Six bags, five faults",
    scenarios=[
        Scenario(None, SECONDS, number, functools.partial(companions, kind), name=kind, waits=False)
        for number, kind in enumerate(KINDS, 1)
    ],
    variants=Variants({"topic": ("/diagnosis", "/bag_diagnosis", "/fault")}, texts=("{topic}",)),
)


class Diagnosis(NamedTuple):
    """A node's report: the fault, how large it is, and where and when (s since 1970) it shows."""

    name: str
    amount: str
    topic: str
    stamp: str


@bag_faults.check(1)
def reports(run: Recording) -> Diagnosis:
    """The last DiagnosticStatus on /diagnosis has one of the six names."""
    return _diagnosis(run)


@bag_faults.check(2.5, after=reports, only=(NONE, BUSY))
def leaves_the_healthy_alone(run: Recording) -> None:
    """A bag without a fault is reported as `none`, also if the network is slow and odometry has 40 Hz."""
    found = _diagnosis(run)
    if found.name != NONE:
        raise Missed("none: this robot is healthy", found.name, _false_alarm(found.name))


@bag_faults.check(2.5, after=reports, only="wheel_radius")
def finds_the_wheel_radius(run: Recording) -> None:
    """A wrong wheel radius is found: by which factor odometry is too long, and a moment in which it shows."""
    _require(
        run,
        "wheel_radius",
        hint="A gyro knows nothing of wheels: compare its turning rate with that of "
        "/odom, after you have subtracted its bias, which you measure while the robot stands still.",
    )


@bag_faults.check(2.5, after=reports, only="lidar_yaw")
def finds_the_lidar_askew(run: Recording) -> None:
    """A lidar that is mounted askew is found: by which angle, and a moment in which it shows."""
    _require(
        run,
        "lidar_yaw",
        hint="Draw scans of different places in the frame odom: with the right angle "
        "they lie on one another, with a wrong one each wall is there several times.",
    )


@bag_faults.check(2.5, after=reports, only="clock_offset")
def finds_the_clock(run: Recording) -> None:
    """A sensor whose clock jumps is found: by how many seconds, which sensor, and a moment after the jump."""
    _require(
        run,
        "clock_offset",
        hint="Compare the ages (arrival minus stamp) of one topic before and after: "
        "the network delays all topics alike, a clock belongs to one sensor.",
    )


@bag_faults.check(2.5, after=reports, only="missing_transform")
def finds_the_missing_transform(run: Recording) -> None:
    """A missing or late transform of the lidar is found: for how long scans have to do without it."""
    _require(
        run, "missing_transform", hint="For each scan: has a transform to its frame_id been received yet?"
    )


@bag_faults.check(2.5, after=reports, only="two_odometries")
def finds_the_second_odometry(run: Recording) -> None:
    """A second publisher of odometry is found: how far apart the two are, and when both publish."""
    _require(run, "two_odometries", hint="Can the robot have moved that far since the previous message?")


def _diagnosis(run: Recording) -> Diagnosis:
    status = publishes(run, bag_faults.drawn.topic, TYPE)[-1].message
    if status.name not in NAMES:
        hint = "The name of the DiagnosticStatus is that of the fault, as it is written in the task."
        raise Missed(f"one of {', '.join(NAMES)} as name", f"{status.name!r}", hint)
    values = {pair.key: pair.value for pair in status.values}
    return Diagnosis(status.name, *(values.get(key, "") for key in ("amount", "topic", "stamp")))


def _require(run: Recording, kind: str, hint: str) -> None:
    """Raise Missed unless all three parts of a diagnosis are right."""
    case, found = draw_case(kind, run.seed), _diagnosis(run)
    if found.name != kind:
        raise Missed(kind, found.name, hint)
    amount = _number(found.amount)
    if not is_near(amount, case.amount, EXACT[kind]):
        unit, about = UNITS.get(kind, " s"), f"amount {found.amount!r}" if found.amount else "no amount"
        raise Missed(
            f"amount {case.amount:.3g}{unit}, within {EXACT[kind]:.2g}", about, _amount_hint(case, amount)
        )
    if found.topic not in case.topics:
        expected = f"topic {' or '.join(case.topics)}"
        raise Missed(
            expected, f"topic {found.topic!r}", "Name the topic whose messages are wrong, or missing."
        )
    stamp = _number(found.stamp) - EPOCH / SECOND
    if not _shows(run, case, stamp):
        raise Missed(
            "the stamp of a moment in which the fault shows", _when(found.stamp, stamp), _moment_hint(case)
        )


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _when(text: str, stamp: Seconds) -> str:
    if not math.isfinite(stamp):
        return f"stamp {text!r}" if text else "no stamp"
    return f"{stamp:.3g} s after the robot's start" if 0 <= stamp < 2 * END else f"stamp {text!r}"


def _shows(run: Recording, case: Case, stamp: Seconds) -> bool:
    """Return whether a fault shows at a moment, which may be NaN."""
    if case.kind in ("wheel_radius", "lidar_yaw"):
        return any(is_near(moment, stamp, NEAR) for moment in _moving(run, drives=case.kind == "lidar_yaw"))
    first = case.begin + min(case.amount, 0.0) if case.kind == "clock_offset" else case.begin
    last = END + 1.0
    if case.kind == "missing_transform":
        first, last = BEGIN, BEGIN + case.amount
    return first - LATE <= stamp <= last + LATE


def _moving(run: Recording, *, drives: bool) -> list[Seconds]:
    """Moments at which the robot moves. drives: it isn't enough that it turns."""
    found = []
    for row in run.messages("/odom"):
        if row.from_course:
            twist = row.message.twist.twist
            speeds = [twist.linear.x] if drives else [twist.linear.x, twist.angular.z]
            if not all(is_near(speed, 0.0, MOVING) for speed in speeds):
                found.append(since_start(row.message.header.stamp))
    return found


def _amount_hint(case: Case, amount: float) -> str:
    exact, right = EXACT[case.kind], case.amount
    if math.isnan(amount):
        return "Publish a KeyValue with the key `amount`, and the number alone as a string."
    if is_near(amount, -right, exact) and case.kind != "wheel_radius":
        return "The sign is wrong: an angle to the left is positive, and so is a clock that is ahead."
    if case.kind == "wheel_radius":
        if is_near(amount, 1 / right, exact):
            return "It is the other way round: odometry's motion divided by the true one."
        return "The factor is odometry's motion divided by the true one: above 1 if it counts too much."
    if case.kind == "lidar_yaw":
        if is_near(math.radians(amount), right, exact):
            return "That is in degrees: an angle in ROS is in radians."
        whole = math.remainder(right + case.mount[2] - amount, math.tau)
        if is_near(whole, 0.0, exact):
            return "That is the whole angle of the lidar: how far is it from what /tf_static says?"
        return "It is the angle by which the lidar is turned further than /tf_static says. Try finer steps."
    if case.kind == "clock_offset":
        return (
            "It is the difference of the ages before and after the jump, and not a mean over the whole bag: "
            "the clock was right at first."
        )
    if case.kind == "missing_transform":
        return "It is the time from the first scan to the transform; to the last scan, if it never comes."
    return "It is the distance between what the two report at the same moment, in meters."


def _moment_hint(case: Case) -> str:
    if case.kind in ("wheel_radius", "lidar_yaw"):
        return (
            "While the robot stands still, this fault doesn't show: take the stamp of a message at which it "
            "drives."
        )
    if case.kind == "missing_transform":
        return "Take the stamp of a scan that can't be transformed yet."
    return "The fault begins in the middle of the bag: take a stamp after that, in seconds since 1970."


def _false_alarm(name: str) -> str:
    return {
        "clock_offset": "All topics are late alike: that is the network, and no clock.",
        "two_odometries": "A higher rate is no second publisher: do the poses jump?",
        "missing_transform": "/tf_static has several messages: keep the transforms of all of them.",
    }.get(name, "Which number made you suspicious, and how large is it in a bag without a fault?")
