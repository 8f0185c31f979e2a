"""The project: a safety node between a careless driver and the robot."""

import itertools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from grader.checks import Missed, keeps_clear, lasts, otherwise, publishes, subscribes
from grader.checks.twists import OUT, TWIST, Speeds, speeds, speeds_text
from grader.companions.blind_drivers import CarelessDriver, CrashingDriver
from grader.companions.radios import BadRadio, Radio
from grader.diagnosis.driving import still_obeyed
from grader.exercise import Exercise, Scenario
from grader.responses import Window, from_course, last_before, same
from grader.responses.speeds import STANDING
from grader.responses.speeds import speeds as speeds_along
from grader.worlds.rooms import free_start, long_hall, short_sighted
from grader.worlds.trusting import trusting
from sim import Process
from sim.evidence import Recording, Seconds, since_start, stamps

RAW, LIDAR = "/cmd_vel_raw", "/lidar"
STEP = 0.1  # seconds between the moments that are looked at
FRESH = 0.2  # seconds: younger commands and scans are good for sure
FREE, BLOCKED = 1.0, 0.45  # meters ahead: the limit is 0.5 m
ENOUGH = 5  # moments
SETTLING = 1.0  # seconds to notice that something is old, and to brake


class Moment(NamedTuple):
    """A guard's knowledge at a moment, and what it published."""

    stamp: Seconds
    requested: Speeds | None  # by the driver; None if that is old, or about to change
    ahead: float  # the nearest distance ahead, m; nan where the scans are old
    sent: Speeds | None  # None if nothing was sent lately


class Ahead(NamedTuple):
    """A scan as received: when it came, how old it was then, and the nearest distance ahead."""

    stamp: Seconds
    age: Seconds
    distance: float  # m, within 60 degrees of straight ahead


REMAPPED = [(OUT, RAW)]

guard = Exercise("guard", "A guard for the robot", scenarios=[
    Scenario(free_start, 40, 1, [Radio, Process(CarelessDriver, remappings=REMAPPED)]),
    Scenario(trusting(lambda seed: short_sighted(long_hall(seed))), 24, 2,
             [BadRadio, Process(CrashingDriver, remappings=REMAPPED)]),
])


@guard.check(3, guess="The driver publishes on /cmd_vel_raw, the lidar on /lidar, and the robot subscribes "
             "to /cmd_vel.")
def stands_between(run: Recording) -> None:
    """The node subscribes to /cmd_vel_raw and /lidar, and publishes Twist messages on /cmd_vel."""
    subscribes(run, RAW, TWIST)
    subscribes(run, LIDAR, "sensor_msgs/msg/LaserScan")
    publishes(run, OUT, TWIST, at_least=10)


@guard.check(4, after=stands_between, hints={
    "There was a fault earlier, but all is well again: now the commands should pass again.":
        lambda run, moment: any(fault.end < moment.stamp
                                for fault in (*_pauses(run, RAW), *_pauses(run, LIDAR), *_delays(run))),
    "Publish from a timer, 20 times a second: without commands the robot stops after 0.5 s.":
        lambda run, moment: moment.sent is None,
    "It sends zeros although all is well. Print what is_well() returns: it needs a `return`, and ages "
    "are in seconds. If it returns True, something beside the robot may be stopping it: check only 30 "
    "degrees to each side.":
        lambda run, moment: moment.sent == (0.0, 0.0),
    "Copy the driver's linear.x and angular.z unchanged.": otherwise,
})
def lets_through(run: Recording) -> list[Moment]:
    """Harmless commands pass: while all is well and 1 m ahead is clear, the robot obeys the driver."""
    moments = list(_moments(run))
    fine = [moment for moment in moments if moment.requested and moment.ahead > FREE]
    wrong = [moment for moment in fine if not (moment.sent and same(moment.sent, moment.requested, 0.05))]
    steps = len({int(moment.stamp / STEP) for moment in fine})
    if steps < ENOUGH:
        expected = f"{ENOUGH * STEP:g} s or more in which all is well and {FREE:g} m ahead are clear"
        hint = "The driver turns the robot away from walls and drives on: its commands have to get through."
        saw = f"{steps * STEP:.1f} s: the robot never gets there"
        raise Missed(expected, saw, hint, picture="path")
    if len(wrong) > 0.05 * len(fine):
        first = wrong[0]
        expected = (f"{_text(first.requested)} at {first.stamp:.3g} s, as the driver commands: "
                    f"{first.ahead:.2f} m ahead are clear")
        raise Missed(expected, _text(first.sent), picture="topics", about=(first,))
    lasts(run, OUT)
    return moments


@guard.check(5, after=lets_through)
def keeps_from_hitting(run: Recording) -> None:
    """The robot touches nothing, wherever the driver steers it."""
    hint = ("When something is closer than 0.5 m within 30 degrees of straight ahead, set linear.x to 0. "
            "Those rays are at the two ends of msg.ranges. Fewer aren't enough: the robot is 20 cm wide.")
    keeps_clear(run, hint)


@guard.check(2, after=lets_through)
def lets_turn(run: Recording, moments: list[Moment]) -> None:
    """In front of a wall it removes only the forward speed: the driver can still turn the robot."""
    for moment in moments:
        turn = moment.requested[1] if moment.requested and moment.ahead < BLOCKED else 0.0
        if turn and not (moment.sent and same(moment.sent[1], turn, 0.05)):
            expected = f"a turn of {turn:g} rad/s at {moment.stamp:.3g} s, as the driver commands"
            hint = "Set linear.x to 0, and leave angular.z alone: turning on the spot hits nothing."
            raise Missed(expected, _text(moment.sent), hint)


@guard.check(3, after=lets_through)
def stops_without_driver(run: Recording) -> None:
    """When the driver falls silent, the robot stops within 1 s."""
    hint = ("Store when the last command arrived, and check its age in the timer: if it is older than 0.3 "
            "s, publish zeros. Otherwise the timer repeats the last command forever.")
    _stands(run, _pauses(run, RAW), "the driver's last command", hint)


@guard.check(3, after=lets_through)
def stops_without_scans(run: Recording) -> None:
    """When the scans stop coming, the robot stops within 1 s."""
    hint = ("No news is bad news. Store when the last scan arrived, and check its age in the timer, not in "
            "the scan's callback, which isn't called any more.")
    _stands(run, _pauses(run, LIDAR), "the last scan", hint)


@guard.check(2, after=(lets_through, stops_without_scans))
def stops_with_late_scans(run: Recording) -> None:
    """When the scans arrive 1 s late, the robot stops within 1 s."""
    hint = ("Scans do arrive, 20 a second, but they are old. The age is not the time since the scan arrived "
            "but the time since it was measured: now minus msg.header.stamp.")
    _stands(run, _delays(run), "the last scan that came in time", hint)


def _stands(run: Recording, windows: list[Window], what: str, hint: str) -> None:
    """Raise Missed where the robot still moves, 1 s after a window has begun."""
    for begin, end in windows:
        path = Window(begin + SETTLING, end).rows(run.path)
        fastest = max(speeds_along(path), key=lambda speed: (speed.linear, speed.stamp), default=None)
        if fastest and fastest.linear > STANDING:
            expected = f"the robot standing still, {SETTLING:g} s after {what} (at {begin:.3g} s)"
            saw = f"it drives at {fastest.linear:.2f} m/s at {fastest.stamp:.3g} s"
            hint = still_obeyed(run, begin + SETTLING) or hint
            raise Missed(expected, saw, hint, picture="topics", unsafe=True)


def _text(command: Speeds | None) -> str:
    return "no command for 0.3 s" if command is None else speeds_text(command)


def _pauses(run: Recording, topic: str) -> list[Window]:
    """Return where nothing of the course came on a topic for more than 1.5 s."""
    return _gaps(stamps(from_course(run, topic, at_least=0)))


def _delays(run: Recording) -> list[Window]:
    """Return where for more than 1.5 s all scans that came were more than half a second old."""
    in_time = [scan.stamp for scan in _scans(run) if scan.age < 0.5]
    return [gap for gap in _gaps(in_time) if gap not in _pauses(run, LIDAR)]


def _gaps(moments: list[Seconds]) -> list[Window]:
    return [Window(a, b) for a, b in itertools.pairwise(moments) if b - a > 1.5]


def _scans(run: Recording) -> list[Ahead]:
    return [
        Ahead(
            row.stamp,
            row.stamp - since_start(row.message.header.stamp),
            float(np.nanmin(np.array(row.message.ranges[:61] + row.message.ranges[-60:]))),
        )
        for row in from_course(run, LIDAR, at_least=0)
    ]


def _moments(run: Recording) -> Iterator[Moment]:
    """What a guard knew, and what it sent: every tenth of a second, and with each command that it sent."""
    scans, sent = _scans(run), run.messages(OUT)
    requested = from_course(run, RAW, at_least=0)
    # Those of a tenth are beside the moments at which timers fire.
    times = [index * STEP + 0.01 for index in range(10, int(run.ended.stamp / STEP))]
    rows = [(now, last_before(sent, now)) for now in times]
    rows += [(row.stamp, row) for row in sent if row.stamp > times[0]]
    for now, last in sorted(rows, key=lambda row: row[0]):
        lately = [now - lag * STEP for lag in range(4)]
        seen = [scan for stamp in lately if (scan := last_before(scans, stamp))]
        commands = [row for stamp in lately if (row := last_before(requested, stamp))]
        good = len(seen) == 4 and all(scan.age < FRESH and now - scan.stamp < 0.5 for scan in seen)
        good = good and now - seen[0].stamp < FRESH and _agree(seen)
        steady = len(commands) == 4 and len({speeds(row) for row in commands}) == 1
        yield Moment(
            now,
            speeds(commands[0]) if steady and now - commands[0].stamp < FRESH else None,
            seen[0].distance if good else math.nan,
            speeds(last) if last and now - last.stamp < 0.3 else None,
        )


def _agree(scans: list[Ahead]) -> bool:
    """Return whether all are free, or all are blocked."""
    return all(scan.distance > FREE for scan in scans) or all(scan.distance < BLOCKED for scan in scans)
