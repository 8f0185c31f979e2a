"""What a guard knew and what it did, from a recording: the evidence for the checks of the project."""

from __future__ import annotations

import bisect
import functools
import itertools
from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from sim.evidence import Message, Recording, Seconds, since_start, stamps

RAW, OUT, LIDAR = "/cmd_vel_raw", "/cmd_vel", "/lidar"
STEP = 0.1  # seconds between the moments that are looked at
FRESH = 0.2  # seconds: younger commands and scans are good for sure
FREE, BLOCKED = 1.0, 0.45  # metres ahead: the limit is 0.5 m

Window = tuple[Seconds, Seconds]  # begin and end


class Moment(NamedTuple):
    """What a guard knew at a moment, and what it let through; a speed and a turn each, m/s and rad/s."""

    stamp: Seconds
    asked: tuple[float, float] | None  # by the driver; None if that is old, or about to change
    ahead: float  # the nearest distance ahead, m; nan where the scans are old
    sent: tuple[float, float] | None  # None if nothing was sent lately


def silences(run: Recording, topic: str) -> list[Window]:
    """Where nothing of ours came on a topic for more than 1.5 s."""
    return _gaps(stamps(_ours(run, topic)))


def delays(run: Recording) -> list[Window]:
    """Where for more than 1.5 s all scans that came were more than half a second old."""
    in_time = [stamp for stamp, age, _ in _scans(run) if age < 0.5]
    return [gap for gap in _gaps(in_time) if gap not in silences(run, LIDAR)]


def _ours(run: Recording, topic: str) -> list[Message]:
    return [heard for heard in run.messages(topic) if heard.from_course]


def _gaps(moments: list[Seconds]) -> list[Window]:
    return [(a, b) for a, b in itertools.pairwise(moments) if b - a > 1.5]


def _scans(run: Recording) -> list[tuple[Seconds, Seconds, float]]:
    """When each scan came, how old it was then, and the nearest distance within 60 degrees of ahead."""
    found = []
    for heard in _ours(run, LIDAR):
        message = heard.message
        measured = since_start(message.header.stamp)
        ahead = np.array(message.ranges[:61] + message.ranges[-60:])
        found.append((heard.stamp, heard.stamp - measured, float(np.nanmin(ahead))))
    return found


def moments_of(run: Recording) -> Iterator[Moment]:
    """What a guard knew, and what it sent: every tenth of a second, and with each command that it sent."""
    scans, asked, sent = _scans(run), _commands(_ours(run, RAW)), _commands(run.messages(OUT))
    scan_at = _latest(scans)
    asked_at, sent_at = _latest(asked), _latest(sent)
    # Those of a tenth are beside the moments at which timers fire.
    times = [index * STEP + 0.01 for index in range(10, int(run.ended.stamp / STEP))]
    looks = [(now, sent_at(now)) for now in times]
    looks += [(command[0], command) for command in sent if command[0] > times[0]]
    for now, last in sorted(looks, key=lambda look: look[0]):
        seen = [scan_at(now - lag) for lag in (0.0, STEP, 2 * STEP, 3 * STEP)]
        wishes = [asked_at(now - lag) for lag in (0.0, STEP, 2 * STEP, 3 * STEP)]
        good = all(seen) and all(age < FRESH and now - came < 0.5 for came, age, _ in seen)
        good = good and now - seen[0][0] < FRESH
        steady = all(wishes) and len({wish[1:] for wish in wishes}) == 1 and now - wishes[0][0] < FRESH
        yield Moment(
            now,
            wishes[0][1:] if steady else None,
            _cautious([ahead for _, _, ahead in seen]) if good else float("nan"),
            last[1:] if last and now - last[0] < 0.3 else None,
        )


def _cautious(ahead: list[float]) -> float:
    """The distance that counts for both sides: all are free, or all are blocked, or neither."""
    if min(ahead) > FREE or max(ahead) < BLOCKED:
        return ahead[0]
    return float("nan")


def _commands(messages: list[Message]) -> list[tuple[Seconds, float, float]]:
    sent = [(heard.stamp, heard.message) for heard in messages]
    return [(stamp, twist.linear.x, twist.angular.z) for stamp, twist in sent]


def _latest(items: list[tuple]) -> Callable[[Seconds], tuple | None]:
    """A function of a moment that gives the last item which is not later."""
    moments = [item[0] for item in items]

    def at(moment: Seconds) -> tuple | None:
        index = bisect.bisect_right(moments, moment) - 1
        return items[index] if index >= 0 else None

    return functools.cache(at)
