"""Six numbers about a bag: QoS, rate, gap, age, and static transforms."""

import functools
import itertools
import math
import statistics
from typing import NamedTuple

from grader.checks import Missed, publishes
from grader.exercise import Exercise, Scenario
from grader.exercises.bags.bag_report.quiet_lidar import SCAN, draw_bag, example_bag, player
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Recording, Seconds, since_start
from sim.nanoseconds import EPOCH, SECOND

__all__ = ["bag_report", "example_bag"]

TOPIC, TYPE = "/bag_report", "diagnostic_msgs/msg/DiagnosticStatus"
SECONDS = 36.0
WHOLE, LATE = "whole", "late"
RATE, GAP, AGE = 0.015, 0.06, 0.012  # as a fraction; s; s

bag_report = Exercise(
    "bag_report",
    "A bag in six numbers",
    scenarios=[
        Scenario(None, SECONDS, 1, functools.partial(player, begins_late=False), name=WHOLE, waits=False),
        Scenario(None, SECONDS, 2, functools.partial(player, begins_late=True), name=LATE, waits=False),
    ],
    variants=Variants(
        {"gap": ("gap", "silence"), "gap_begin": ("gap_begin", "silence_begin")},  # keys of the values
        {"age": ("age", "latency")},
        texts=("`{gap}`", "`{gap_begin}`", "`{age}`", '"{gap}"', '"{gap_begin}"', '"{age}"'),
    ),
)


class BagScan(NamedTuple):
    """A scan of the bag: when it was measured, and when it arrived (s)."""

    measured: Seconds
    arrived: Seconds


@bag_report.check(1)
def reports(run: Recording) -> dict[str, str]:
    """The node publishes a DiagnosticStatus on /bag_report; the last one has values."""
    status = publishes(run, TOPIC, TYPE)[-1].message
    if not status.values:
        hint = "status.values = [KeyValue(key=..., value=...), ...], where both are strings."
        raise Missed("values with the six keys", "no values", hint)
    return {pair.key: pair.value for pair in status.values}


@bag_report.check(1, after=reports)
def knows_the_reliability(run: Recording, values: dict[str, str]) -> None:
    """`reliability` is that with which /scan was published: `reliable` or `best_effort`."""
    offered = draw_bag(run.seed, begins_late=_is_late(run)).qos["reliability"]
    if values.get("reliability") != offered:
        hint = (
            'get_publishers_info_by_topic("/scan") lists the publishers; the profile of each has a '
            "reliability, and that a name."
        )
        raise Missed(f"reliability {offered}", _saw(values, "reliability"), hint)


@bag_report.check(1, after=reports)
def knows_the_rate(run: Recording, values: dict[str, str]) -> None:
    """`rate` is how often the lidar measures while it works, in Hz, within 1.5 %."""
    right, steps = _rate(run), _steps(run)
    if not is_near(_number(values, "rate"), right, RATE * right):
        hint = "Take the median of the times between two stamps: the rate is 1 / that."
        if is_near(_number(values, "rate"), 1 / statistics.mean(steps), RATE * right):
            hint = "That is the mean over all of the bag: it counts the silence, too. Take the median."
        elif is_near(_number(values, "rate"), 1 / right, RATE):
            hint = "That is the period, in seconds: the rate is 1 / period."
        raise Missed(f"rate {right:.3g}", _saw(values, "rate"), hint)


@bag_report.check(2, after=reports)
def knows_the_gap(run: Recording, values: dict[str, str]) -> None:
    """`gap` is the longest time between two scans, in s, and `gap_begin` the stamp of the scan before it."""
    scans = _scans(run)
    key, begin_key = bag_report.drawn.gap, bag_report.drawn.gap_begin
    gap, begin = max((b.measured - a.measured, a.measured) for a, b in itertools.pairwise(scans))
    if not is_near(_number(values, key), gap, GAP):
        hint = "The gap is the longest time between the stamps of two scans that follow one another."
        arrivals = sorted(scan.arrived for scan in scans)
        if is_near(_number(values, key), max(b - a for a, b in itertools.pairwise(arrivals)), GAP):
            hint = (
                "That is the longest time between two arrivals: there the radio was silent, and the lidar "
                "went on. When scans were measured is in their stamps."
            )
        raise Missed(f"{key} {gap:.3g} s", _saw(values, key), hint)
    found = _number(values, begin_key) - EPOCH / SECOND
    if not is_near(found, begin, GAP):
        hint = "It is the stamp of the scan before the gap, since 1970: stamp.sec + stamp.nanosec / 1e9."
        raise Missed(f"{begin_key} {EPOCH / SECOND + begin:.2f}", _saw(values, begin_key), hint)


@bag_report.check(1, after=reports)
def knows_the_age(run: Recording, values: dict[str, str]) -> None:
    """`age` is the median of the scans' ages as they arrive, in s, within 0.012 s."""
    ages = [scan.arrived - scan.measured for scan in _scans(run)]
    key, right = bag_report.drawn.age, statistics.median(ages)
    if not is_near(_number(values, key), right, AGE):
        hint = (
            "Take the time at which the callback is called, by the node's clock, minus the stamp of the scan."
        )
        if is_near(_number(values, key), -right, AGE):
            hint = "It is arrival minus stamp, not the other way round."
        elif is_near(_number(values, key), statistics.mean(ages), AGE):
            hint = "That is the mean: a few scans that waited for the radio push it up. Take the median."
        raise Missed(f"{key} {right:.3g} s", _saw(values, key), hint)


@bag_report.check(2, after=reports)
def counts_static_transforms(run: Recording, values: dict[str, str]) -> None:
    """`static_transforms` is how many transforms are on /tf_static: 0 if the bag began too late."""
    right = sum(len(row.message.transforms) for row in run.messages("/tf_static") if row.from_course)
    if not is_near(_number(values, "static_transforms"), right, 0.01):
        hint = (
            "/tf_static is latched: request TRANSIENT_LOCAL with a depth of 10 or more, and count the "
            "transforms of each message."
        )
        if right == 0:
            hint = "No transform is in this bag: report 0, and all other numbers, too."
        raise Missed(f"static_transforms {right}", _saw(values, "static_transforms"), hint)


def _is_late(run: Recording) -> bool:
    return not run.messages("/tf_static")


def _scans(run: Recording) -> list[BagScan]:
    rows = [row for row in run.messages(SCAN) if row.from_course]
    return sorted(BagScan(since_start(row.message.header.stamp), row.stamp) for row in rows)


def _steps(run: Recording) -> list[Seconds]:
    return [b.measured - a.measured for a, b in itertools.pairwise(_scans(run))]


def _rate(run: Recording) -> float:
    return 1 / statistics.median(_steps(run))


def _number(values: dict[str, str], key: str) -> float:
    try:
        return float(values.get(key, ""))
    except ValueError:
        return math.nan


def _saw(values: dict[str, str], key: str) -> str:
    return f"{key} {values[key]!r}" if key in values else f"no key {key!r}"
