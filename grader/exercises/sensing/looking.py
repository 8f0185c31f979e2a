"""An exercise on the lidar: the nearest thing ahead, to the left and to the right."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from grader.checks import Missed, hinting, lasts, publishes, subscribes
from grader.companions.blind_drivers import Circling
from grader.companions.strange_lidar import StrangeLidar
from grader.exercise import Exercise, Scenario
from grader.worlds.rooms import furnished_room
from sim.evidence import Message, Recording, Seconds, stamps

SCAN, FLOAT64 = "sensor_msgs/msg/LaserScan", "std_msgs/msg/Float64"
MIDDLES = {"/front": 0.0, "/left": 90.0, "/right": -90.0}  # degrees
HALF = 30.0  # degrees to each side
BESIDE = 60.0  # degrees: as far off one still takes for ahead
EDGE = 1.0  # degrees: whether a ray so near to a sector's edge belongs to it is left open
LAG, PATIENCE = 0.02, 0.3  # seconds


class Sector(NamedTuple):
    """The rays of one direction in a scan."""

    rays: np.ndarray  # with those at its edges
    inner: np.ndarray  # without them
    middle: float  # the one ray in the middle
    beside: np.ndarray  # those farther off, up to 60 degrees
    around: float  # the nearest distance of all directions, m
    numbers: np.ndarray  # of `rays`, in the scan

    @property
    def kind(self) -> str:
        """What is special in it: near, empty, lost, or plain where nothing is."""
        if np.isneginf(self.rays).any():
            return "near"
        if not np.isfinite(self.rays).any():
            return "empty"
        return "lost" if np.isnan(self.rays).any() else "plain"

    @property
    def nearest(self) -> float:
        """The distance of the nearest thing, m."""
        return max(0.0, _least(self.inner))

    @property
    def told(self) -> str:
        """The end of a sentence on what is special in it, and the first ray that says so; "" for nothing."""
        if self.kind == "empty":
            return ": there is no ray with a distance"
        marked = np.isneginf(self.rays) if self.kind == "near" else np.isnan(self.rays)
        first = marked.argmax()
        return f": ray {self.numbers[first]} says {self.rays[first]:g}" if marked[first] else ""

    def fits(self, said: float | None) -> bool:
        """Is this what the rays say?"""
        if said is None:
            return False
        return said == self.nearest or max(0.0, _least(self.rays)) - 0.001 <= said <= self.nearest + 0.001


class Look(NamedTuple):
    """What a node said of a direction after a scan, None for nothing, and what there was to see."""

    stamp: Seconds
    topic: str
    said: float | None
    sector: Sector
    before: Sector | None  # of the scan before, where the node may not have heard this one yet

    @property
    def right(self) -> bool:
        """Is it what the rays say?"""
        return self.sector.fits(self.said) or (self.before is not None and self.before.fits(self.said))


def _least(rays: np.ndarray) -> float:
    known = rays[~np.isnan(rays)]
    return float(known.min()) if len(known) else math.inf


sectors = Exercise(
    "sectors",
    "Ahead, left and right",
    scenarios=[
        Scenario(world=furnished_room, seconds=6, seed=1, companions=[Circling]),
        Scenario(seconds=12, seed=2, companions=[StrangeLidar]),
    ],
)


@sectors.check(3)
def says_three_distances(run: Recording) -> list[Look]:
    """The node hears /scan, and publishes Float64 messages on /front, /left and /right."""
    subscribes(run, "/scan", SCAN)
    with hinting(guess="A publisher for each of the three, and a message on each after every scan."):
        for topic in MIDDLES:
            publishes(run, topic, FLOAT64, at_least=5)
    return list(_looks(run))


@sectors.check(5, after=says_three_distances)
def knows_the_directions(run: Recording, looks: list[Look]) -> list[Look]:
    """Each is the nearest distance of its direction, 30 degrees to both sides, with any lidar."""
    wrong = [look for look in looks if look.sector.kind == "plain" and not look.right]
    if wrong:
        _miss(wrong[0], _why_wrong(run, looks, wrong))
    for topic in MIDDLES:
        lasts(run, topic)
    return looks


@sectors.check(4, after=knows_the_directions)
def leaves_out_lost_rays(run: Recording, looks: list[Look]) -> None:
    """Rays that got lost (nan) change nothing."""
    hint = "Leave them out before min(): `if not math.isnan(distance)`. Every comparison with nan is False."
    _all_right(looks, "lost", hint)


@sectors.check(3, after=knows_the_directions)
def knows_near_and_far(run: Recording, looks: list[Look]) -> None:
    """Where nothing is, it says inf; what is too near to be measured (-inf) is 0.0 m away."""
    near = "max(0.0, distance) makes 0.0 of -inf, and leaves everything else as it is."
    _all_right(looks, "near", near)
    far = "Where all rays are inf, the answer is inf. Leave out nan only, and give an empty list a default."
    _all_right(looks, "empty", far)


def _all_right(looks: list[Look], kind: str, hint: str) -> None:
    wrong = [look for look in looks if look.sector.kind == kind and not look.right]
    if wrong:
        _miss(wrong[0], hint)


def _miss(look: Look, hint: str) -> None:
    raise Missed(
        f"{look.sector.nearest:.3g} m on {look.topic} at {look.stamp:.3g} s{look.sector.told}",
        "nothing" if look.said is None else f"{look.said:.3g} m",
        hint,
    )


def _why_wrong(run: Recording, looks: list[Look], wrong: list[Look]) -> str:
    """The usual reasons for a wrong distance."""
    first, sides = wrong[0], [look for look in wrong if look.topic != "/front"]
    if all(look.said == look.sector.middle for look in wrong):
        return "That is one ray only. Take the least of all rays up to 30 degrees to both sides of it."
    firsts = [look for look in wrong if look.said == look.sector.middle != math.inf]
    if firsts and all(look.said == math.inf for look in wrong if look not in firsts):
        return "That is the first ray, or none at all: does `return` stand behind the loop, not inside of it?"
    if all(look.said is not None and look.said >= look.sector.rays.max() for look in wrong):
        return "That is the greatest distance. min(...) finds the least one."
    if all(look.said == look.sector.around for look in wrong if look.topic == first.topic):
        return (
            "That is the nearest distance of all directions. Are both angles in degrees? "
            "math.degrees(...) makes degrees of radians."
        )
    if run.world is None:
        return _why_another_lidar(looks, first)
    if any(look.said in look.sector.rays for look in sides if look.said and math.isfinite(look.said)):
        return "That is in this direction, but not all of it: take the rays up to 30 degrees to both sides."
    if sides and all(look.said in look.sector.beside for look in sides):
        return "That is too far to the side: only the rays up to 30 degrees from the middle count."
    if first.topic == "/front":
        return (
            "Ahead lies at both ends of this lidar's ranges: a ray at 350 degrees is the same as one at "
            "-10. Bring the difference of two angles into -180 to 180: (angle - middle + 180) % 360 - 180."
        )
    return "Angles count from ahead to the left, in radians: 90 degrees is the left, -90 (or 270) the right."


def _why_another_lidar(looks: list[Look], wrong: Look) -> str:
    near = [item for item in looks if item.stamp == wrong.stamp and item.topic != wrong.topic]
    if wrong.said is not None and any(abs(item.sector.nearest - wrong.said) < 0.001 for item in near):
        return (
            "That is the distance of another direction. This lidar's first ray looks back (angle_min "
            "is -180 degrees), and it has 180 rays: the angle of ray i is msg.angle_min + i * "
            "msg.angle_increment."
        )
    return (
        "This lidar has 180 rays, and its first one looks back. So don't count rays: work out the "
        "angle of each, msg.angle_min + i * msg.angle_increment."
    )


def _looks(run: Recording) -> Iterator[Look]:
    """What was said after each scan: the last message on a topic before the next one came."""
    scans = run.messages("/scan")
    messages = {topic: run.messages(topic) for topic in MIDDLES}
    times = {topic: stamps(heard) for topic, heard in messages.items()}
    before: dict[str, Sector] = {}
    for scan, following in itertools.pairwise(scans):
        seen = _sectors(scan)
        for topic, sector in seen.items():
            if scan.stamp < 0.3:
                continue  # the node may just have come up
            last = bisect.bisect_left(times[topic], following.stamp) - 1
            if last >= 0 and times[topic][last] >= scan.stamp:
                at_once = times[topic][last] < scan.stamp + LAG
                said = messages[topic][last].message.data
                yield Look(scan.stamp, topic, said, sector, before.get(topic) if at_once else None)
            elif following.stamp > scan.stamp + PATIENCE:
                yield Look(scan.stamp, topic, None, sector, None)
        before = seen


def _sectors(scan: Message) -> dict[str, Sector]:
    message = scan.message
    ranges = np.array(message.ranges)
    angles = np.degrees(message.angle_min + np.arange(len(ranges)) * message.angle_increment)
    off = {topic: np.abs((angles - middle + 180.0) % 360.0 - 180.0) for topic, middle in MIDDLES.items()}
    return {
        topic: Sector(
            ranges[far <= HALF + EDGE],
            ranges[far <= HALF - EDGE],
            float(ranges[far.argmin()]),
            ranges[(far > HALF) & (far <= BESIDE)],
            max(0.0, _least(ranges)),
            np.flatnonzero(far <= HALF + EDGE),
        )
        for topic, far in off.items()
    }
