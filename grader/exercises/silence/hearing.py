"""An exercise on a sensor's profile: hear a lidar over radio, and count what got lost."""

from __future__ import annotations

import bisect
import itertools
from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.silence.senders import RADIO, RadioLidar
from sim.evidence import Recording, Seconds

SCAN, COUNT = "sensor_msgs/msg/LaserScan", "std_msgs/msg/Int32"
SOONEST, LATEST = RADIO.delay - RADIO.jitter, RADIO.delay + RADIO.jitter  # s, of a scan on its way

lidar = Exercise("lidar", "What got lost", seconds=8, companions=[RadioLidar], network=RADIO, seeds=(1, 5))


class Counted(NamedTuple):
    """A scan that came, how many had been lost since the first one, and what the node said."""

    stamp: Seconds
    lost: int
    said: int


@lidar.check(2)
def listens_to_scans(run: Recording) -> None:
    """The node subscribes to /scan."""
    with hinting("The lidar publishes its scans on /scan."):
        subscribes(run, "/scan", SCAN)


@lidar.check(3, after=listens_to_scans)
def hears_every_scan(run: Recording) -> list[Counted]:
    """It hears the scans: with each that comes, one count (Int32) goes out on /missed."""
    said = publishes(run, "/missed", COUNT)
    ways = [way for way in run.crossings if way.topic == "/scan" and way.listener not in run.course_nodes]
    # Each node that listens has its own way, on which others get lost; one of them counts.
    came = [way.sent - way.lost for way in ways]
    arrived = min(came, key=lambda count: abs(count - len(said)), default=0)
    with hinting("Publish in the scan's callback, each time it is called."):
        if not arrived - 1 <= len(said) <= arrived:  # one may be under way in the end
            expected = "one message on /missed for each scan that came"
            raise Missed(expected, f"{len(said)} messages, and {arrived} scans came")
        return _counted(run)


@lidar.check(8, after=hears_every_scan)
def counts_all(run: Recording, counted: list[Counted]) -> None:
    """At the end the count is how many scans have got lost since the first one."""
    last = counted[-1]
    if last.said != last.lost:
        raise Missed(f"{last.lost} lost until {last.stamp:.3g} s", f"{last.said}", _why_wrong(counted))


@lidar.check(3, after=(hears_every_scan, counts_all))
def is_right_all_the_time(run: Recording, counted: list[Counted], end: None) -> None:
    """The count is right after every scan."""
    for one in counted:
        if one.said != one.lost:
            hint = "Count at each scan what was lost since the one before, and add it to the sum."
            raise Missed(f"{one.lost} lost until {one.stamp:.3g} s", f"{one.said}", hint)


def _counted(run: Recording) -> list[Counted]:
    """What was said, each with the scan that had just arrived then: only one can have."""
    sent = [heard.stamp for heard in run.messages("/scan") if heard.from_course]
    found: list[Counted] = []
    first = 0
    for count, heard in enumerate(run.messages("/missed")):
        number = bisect.bisect_right(sent, heard.stamp - SOONEST + 1e-6) - 1
        if number < 0 or heard.stamp - sent[number] > LATEST + 1e-6:
            raise Missed("a count when a scan comes", f"one at {heard.stamp:.3g} s, when none came")
        first = number if count == 0 else first
        found.append(Counted(heard.stamp, number - first - count, heard.message.data))
    return found


def _why_wrong(counted: list[Counted]) -> str:
    """The usual reasons for a wrong sum."""
    last, said = counted[-1], counted[-1].said
    gaps = sum(after.lost > before.lost for before, after in itertools.pairwise(counted))
    if not any(one.said for one in counted):
        return "It stays 0. Two stamps in a row are further apart than scan_time where a scan got lost."
    if said == gaps:
        return "Each gap counts as one, but in a long gap several got lost: gap / scan_time - 1."
    if said == last.lost + len(counted) - 1:
        return "Two scans in a row are one scan_time apart, and nothing got lost: take 1 away from each."
    if said in (len(counted), len(counted) - 1):
        return "That is how many came. Lost are those that should have come in between."
    if said == last.lost - counted[-2].lost:
        return "That is what was lost before the last scan alone: add it up, self.missed += ..."
    return (
        "How many scans fit into a gap is its seconds divided by scan.scan_time, rounded. The gap is that "
        "between the two header stamps: scans also come early or late."
    )
