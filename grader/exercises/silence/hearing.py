"""An exercise on a sensor's profile: hear a lidar over radio, and count what got lost."""

from __future__ import annotations

import itertools
from typing import NamedTuple

from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.silence import silence
from grader.exercise import Exercise
from grader.exercises.silence.senders import RadioLidar
from sim.evidence import Heard, Recording, Seconds

SCAN, COUNT = "sensor_msgs/msg/LaserScan", "std_msgs/msg/Int32"

lidar = Exercise("lidar", "What got lost", seconds=8, companions=[RadioLidar], seeds=(1, 2))


class Counted(NamedTuple):
    """A scan that came, how many were lost before it, and what the node said until the next one came."""

    stamp: Seconds
    lost: int
    said: tuple[int, ...]


@lidar.check(2)
def listens_to_scans(run: Recording) -> None:
    """The node subscribes to /scan."""
    with hinting("The lidar publishes its scans on /scan."):
        subscribes(run, "/scan", SCAN)


@lidar.check(5, after=listens_to_scans)
def hears_every_scan(run: Recording) -> None:
    """It hears the scans: with each of them, one count (Int32) goes out on /missed."""
    with hinting(guess="Publish in the scan's callback, each time it is called."):
        publishes(run, "/missed", COUNT)
        for one in _counted(run):
            if len(one.said) != 1:
                saw = f"{len(one.said)} for the scan that came at {one.stamp:.3g} s"
                raise Missed("one message on /missed for each scan", saw)


@lidar.check(6, after=hears_every_scan)
def counts_all(run: Recording) -> None:
    """At the end the count is how many scans have got lost in all."""
    last = _counted(run)[-1]
    if last.said != (last.lost,):
        expected = f"{last.lost} lost until {last.stamp:.3g} s"
        raise Missed(expected, f"{last.said[0] if last.said else 'nothing'}", _why_wrong(run, last))


@lidar.check(3, after=counts_all)
def is_right_all_the_time(run: Recording) -> None:
    """The count is right after every scan."""
    for one in _counted(run):
        if one.said != (one.lost,):
            expected = f"{one.lost} lost until {one.stamp:.3g} s"
            hint = "Count at each scan what was lost since the one before, and add it to the sum."
            raise Missed(expected, f"{one.said[0] if one.said else 'nothing'}", hint)


def _measured(heard: Heard) -> Seconds:
    stamp = heard.message.header.stamp
    return stamp.sec + stamp.nanosec / 1e9


def _counted(run: Recording) -> list[Counted]:
    """All scans that came, but for the last, whose count may not have been sent yet."""
    scans = [heard for heard in run.messages("/scan") if heard.ours]
    if len(scans) < 3:
        raise silence(run, "three scans or more", f"{len(scans)}", run.graph.publishers("/scan"))
    said, lost, counted = run.messages("/missed"), 0, []
    for index, scan in enumerate(scans[:-1]):
        if index:
            gap = _measured(scan) - _measured(scans[index - 1])
            lost += round(gap / scan.message.scan_time) - 1
        end = scans[index + 1].stamp
        told = [one.message.data for one in said if scan.stamp <= one.stamp < end]
        counted.append(Counted(scan.stamp, lost, tuple(told)))
    return counted


def _why_wrong(run: Recording, last: Counted) -> str:
    """The usual reasons for a wrong sum."""
    counted, said = _counted(run), last.said[0]
    gaps = sum(after.lost > before.lost for before, after in itertools.pairwise(counted))
    if not any(value for one in counted for value in one.said):
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
