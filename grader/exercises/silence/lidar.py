"""A sensor's QoS profile: receive a lidar over a lossy network, and count what got lost."""

import bisect
import itertools
from typing import NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.checks.work import worked_until
from grader.companions.radios import RADIO, RadioLidar
from grader.exercise import Exercise
from grader.responses import EDGE, from_course
from sim.evidence import Recording, Seconds, since_start

SCAN, COUNT = "sensor_msgs/msg/LaserScan", "std_msgs/msg/Int32"
BEGUN, MOST = 1.0, 0.8  # s until a node has begun; of the scans after that, how many must be sent to it
SOONEST, LATEST = RADIO.delay - RADIO.jitter, RADIO.delay + RADIO.jitter  # s, of a scan on its way

lidar = Exercise("lidar", "What got lost", seconds=8, companions=[RadioLidar], network=RADIO, seeds=(1, 5))


class Counted(NamedTuple):
    """A scan that arrived, how many had been lost since the first one, and the published count."""

    stamp: Seconds
    measured: Seconds
    lost: int
    published: int


@lidar.check(2)
def subscribes_to_scans(run: Recording) -> None:
    """The node subscribes to /scan."""
    with hinting("The lidar publishes its scans on /scan."):
        subscribes(run, "/scan", SCAN)


@lidar.check(3, after=subscribes_to_scans)
def receives_every_scan(run: Recording) -> list[Counted]:
    """It receives the scans: for each one that arrives, one count (Int32) is published on /missed."""
    counts = publishes(run, "/missed", COUNT)
    # Each subscribing node loses other messages; one of the nodes counts.
    crossings = [one for one in run.crossings if one.topic == "/scan"]
    listeners = [one for one in crossings if one.listener not in run.course_nodes]
    received = [one.sent - one.lost for one in listeners]
    arrived = min(received, key=lambda number: abs(number - len(counts)), default=0)
    _requires_listening(run, max((one.sent for one in listeners), default=0))
    with hinting("Publish in the scan's callback, each time it is called."):
        if not arrived - 1 <= len(counts) <= arrived:  # one may be on its way at the end
            expected = "one message on /missed for each scan that arrived"
            raise Missed(expected, f"{len(counts)} messages for {arrived} scans")
        return _counted(run)


@lidar.check(8, after=receives_every_scan, hints={
    "It stays 0. When a scan was lost, two successive stamps are more than scan_time apart.":
        lambda run, counted: not any(one.published for one in counted),
    "You count each gap as one, but in a long gap several scans were lost: gap / scan_time - 1.":
        lambda run, counted: counted[-1].published == len({one.lost for one in counted}) - 1,
    "When two scans are one scan_time apart, nothing was lost: subtract 1 from each gap.":
        lambda run, counted: counted[-1].published == counted[-1].lost + len(counted) - 1,
    "That is how many scans arrived. Count those that should have arrived in between.":
        lambda run, counted: all(b.published - a.published == 1 for a, b in itertools.pairwise(counted)),
    "One scan every 0.1 s is a different lidar: each scan contains how long it takes, scan.scan_time.":
        lambda run, counted: counted[-1].published == counted[0].published + sum(
            round((b.measured - a.measured) / 0.1) - 1 for a, b in itertools.pairwise(counted)),
    "That is only what was lost just before the last scan: add it up, self.missed += ...":
        lambda run, counted: counted[-1].published == counted[-1].lost - counted[-2].lost,
    "The number of scans that fit into a gap is its length divided by scan.scan_time, rounded. Take "
    "the gap between the two header stamps, because scans also arrive early or late.": otherwise,
})
def counts_all(run: Recording, counted: list[Counted]) -> None:
    """At the end the count is how many scans were lost since the first one."""
    last = counted[-1]
    if last.published != last.lost:
        expected = f"{last.lost} lost until {last.stamp:.3g} s"
        raise Missed(expected, f"{last.published}", about=(counted,))


@lidar.check(3, after=(receives_every_scan, counts_all))
def is_right_all_the_time(run: Recording, counted: list[Counted], end: None) -> None:
    """The count is right after every scan."""
    for one in counted:
        if one.published != one.lost:
            hint = "At each scan, count what was lost since the previous one, and add it to the total."
            raise Missed(f"{one.lost} lost until {one.stamp:.3g} s", f"{one.published}", hint)


def _requires_listening(run: Recording, sent: int) -> None:
    """Raises Missed where no node of the student's subscribed for most of its time. sent: scans to one."""
    begun = run.started_at + BEGUN
    due = [row for row in run.messages("/scan") if begun < row.stamp < worked_until(run)]
    if sent < MOST * len(due):
        saw = f"{sent} of {len(due)} scans were sent to it, and then the subscription was gone"
        hint = "Create the subscription in __init__, keep it, and never destroy it."
        raise Missed("a subscription to /scan from start to end", saw, hint)


def _counted(run: Recording) -> list[Counted]:
    """The published counts, each with the scan that had just arrived: only one can have."""
    sent = [row.stamp for row in from_course(run, "/scan")]
    scans = [since_start(row.message.header.stamp) for row in from_course(run, "/scan")]
    found: list[Counted] = []
    first = 0
    for count, row in enumerate(run.messages("/missed")):
        number = bisect.bisect_right(sent, row.stamp - SOONEST + EDGE) - 1
        if number < 0 or row.stamp - sent[number] > LATEST + EDGE:
            raise Missed("a count only when a scan arrives",
                         f"one at {row.stamp:.3g} s, when no scan arrived")
        first = number if count == 0 else first
        found.append(Counted(row.stamp, scans[number], number - first - count, row.message.data))
    return found
