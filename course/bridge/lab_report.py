"""Grades the lab: the numbers that a student reports, against what the bag of their drive shows.

    python lab_report.py BAG REPORT.json
"""

import itertools
import json
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lab import Drive, Stop, read, stops

from grader import Missed, Score
from grader.checks import judge, otherwise
from grader.checks.check import Check, Hints, new_check
from sim import Recording

ENOUGH, APART = 3, 0.1  # stops; m/s between the slowest and the fastest
MILLI, CENTI = 1000.0, 100.0
UNIT = "Give it in seconds, meters and m/s, as everywhere in ROS."
NO_STOP: Hints = {
    "Record /cmd_vel, too: a stop begins with a command.": lambda run, drive: not drive.commands,
    "Record /odom, too: it shows how fast the robot was.": lambda run, drive: not drive.odometry,
    "The program falls silent in place of sending 0. Send a Twist() to stop, and go on sending it.": (
        lambda run, drive: drive.commands[-1][1] != 0.0
    ),
    "The speed comes down in steps. Send 0 at once, so that the robot brakes and not your program.": (
        lambda run, drive: _comes_down_in_steps(drive)
    ),
    "Let it drive for 2 s before each stop, and stand for 2 s after it.": otherwise,
}
REACTION: Hints = {
    UNIT: lambda run, value, truth, stop: _near(value, MILLI * truth, 0.1),
    "That is the time until it stands. The reaction ends when the robot begins to slow down.": (
        lambda run, value, truth, stop: _near(value, truth + stop.speed / stop.braking, 0.15)
    ),
    "From the first command of 0 until the speed in /odom begins to fall.": otherwise,
}
BRAKING: Hints = {
    "It is the size of the deceleration, so it is above 0.": lambda run, value, truth, stop: value < 0,
    "The reaction isn't a part of braking: divide by the time in which the speed falls.": (
        lambda run, value, truth, stop: _near(value, stop.speed / (stop.reaction + stop.speed / truth), 0.1)
    ),
    "Speed divided by the time in which it falls to 0: the slope of the line in the picture.": otherwise,
}
DISTANCE: Hints = {
    UNIT: lambda run, value, truth, stop: _near(value, CENTI * truth, 0.1),
    "That is the braking alone. The distance begins where the robot was when you sent 0.": (
        lambda run, value, truth, stop: _near(value, stop.speed**2 / (2 * stop.braking), 0.1)
    ),
    "From where the robot was at the first command of 0 to where it stands, by /odom.": otherwise,
}
PREDICTED: Hints = {
    "The half is missing: speed² / (2 · braking).": (
        lambda run, value, truth, v, t, a: _near(value, v * t + v * v / a, 0.02)
    ),
    "The reaction is missing: before it brakes, the robot drives speed · reaction.": (
        lambda run, value, truth, v, t, a: _near(value, v * v / (2 * a), 0.02)
    ),
    "The speed is squared in the second part.": (
        lambda run, value, truth, v, t, a: _near(value, v * t + v / (2 * a), 0.02)
    ),
    "speed · reaction + speed² / (2 · braking), with the numbers of your report.": otherwise,
}


def lab_score(bag: str | Path, report: Mapping[str, Any]) -> Score:
    """The score of a report about a bag.

    report: scan_reliability, scan_rate (Hz), scan_age (s), and of the fastest stop: speed (m/s), reaction
    (s), braking (m/s²), distance (m), and predicted (m), by the formula.
    """
    drive = read(bag)
    verdicts = judge(_Lab(drive, stops(drive), report).checks(), Recording(), may_end=True)
    return Score("lab", verdicts, title="A real robot: how it stops")


@dataclass(frozen=True)
class _Lab:
    """A report, the drive in the bag, and the stops that were found in it. Its methods are the checks."""

    drive: Drive
    found: list[Stop]
    report: Mapping[str, Any]

    @property
    def fastest(self) -> Stop:
        """The stop from the highest speed."""
        return max(self.found, key=lambda stop: stop.speed)

    def checks(self) -> list[Check]:
        """All checks, in order."""
        first = new_check(self.has_stops, 4, hints=NO_STOP)
        return [
            first,
            new_check(self.names_reliability, 2),
            new_check(self.measures_scans, 3),
            new_check(self.measures_reaction, 3, first, hints=REACTION),
            new_check(self.measures_braking, 3, first, hints=BRAKING),
            new_check(self.measures_distance, 3, first, hints=DISTANCE),
            new_check(self.predicts, 3, hints=PREDICTED),
        ]

    def has_stops(self, run: Recording) -> None:
        """The bag has three stops or more, from speeds that differ by 0.1 m/s at least."""
        expected = f"{ENOUGH} stops or more, {APART:g} m/s apart"
        speeds = sorted(stop.speed for stop in self.found)
        text = ", ".join(f"{speed:.2f}" for speed in speeds)
        if len(self.found) < ENOUGH:
            saw = f"{len(self.found)}: from {text} m/s" if self.found else "none"
            raise Missed(expected, saw, about=(self.drive,))
        if speeds[-1] - speeds[0] < APART:
            saw = f"{len(self.found)} stops, from {text} m/s"
            raise Missed(expected, saw, "Stop from other speeds, too.")

    def names_reliability(self, run: Recording) -> None:
        """The report's scan_reliability is what the lidar's publisher offers."""
        offered, given = self.drive.reliability.get("/scan", "unknown"), self.report.get("scan_reliability")
        allowed = (offered,) if offered != "unknown" else ("reliable", "best_effort")
        if given not in allowed:
            hint = "`ros2 topic info -v /scan` shows it. Write it in small letters: reliable or best_effort."
            raise Missed(" or ".join(allowed), repr(given), hint)

    def measures_scans(self, run: Recording) -> None:
        """The report's scan_rate (Hz) and scan_age (s) are those of the bag."""
        if not self.drive.scans:
            raise Missed("scans in the bag", "none on /scan", "Record /scan, too.")
        _compare(self.report, "scan_rate", self.drive.scan_rate, 0.2, 0.0, "Hz")
        hint = UNIT if _near(_number(self.report, "scan_age"), MILLI * self.drive.scan_age, 0.2) else ""
        hint = hint or "The time at which a scan was recorded, minus its stamp: the median of all."
        _compare(self.report, "scan_age", self.drive.scan_age, 0.2, 0.005, "s", hint)

    def measures_reaction(self, run: Recording) -> None:
        """The report's reaction is the time until the fastest stop begins to slow down."""
        _compare(self.report, "reaction", self.fastest.reaction, 0.0, 0.06, "s", about=(self.fastest,))

    def measures_braking(self, run: Recording) -> None:
        """The report's braking is the deceleration of the fastest stop."""
        _compare(self.report, "braking", self.fastest.braking, 0.2, 0.0, "m/s²", about=(self.fastest,))

    def measures_distance(self, run: Recording) -> None:
        """The report's distance is what the robot drives after the first command of 0."""
        _compare(self.report, "distance", self.fastest.distance, 0.1, 0.02, "m", about=(self.fastest,))

    def predicts(self, run: Recording) -> None:
        """The report's predicted is the distance by the formula of lesson 5, with its own numbers."""
        v, t, a = (_number(self.report, name) for name in ("speed", "reaction", "braking"))
        if not a:
            raise Missed("a braking above 0", "0 m/s²", "Measure it first.")
        wanted = v * t + v * v / (2 * a)
        _compare(self.report, "predicted", wanted, 0.02, 0.001, "m", about=(v, t, a), source="by the formula")


def _number(report: Mapping[str, Any], name: str) -> float:
    value = report.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise Missed(f"a number as {name!r}", repr(value), "Fill in the whole report.")
    return float(value)


def _compare(
    report: Mapping[str, Any],
    name: str,
    truth: float,
    part: float,
    least: float,
    unit: str,
    hint: str = "",
    about: tuple[Any, ...] = (),
    source: str = "as the bag shows it",
) -> None:
    """Raise Missed where a number is off by more than a part of the right one, and by more than `least`."""
    value = _number(report, name)
    if abs(value - truth) > max(part * abs(truth), least):
        limits = [f"{part * 100:g} %"] * bool(part) + [f"{least:g} {unit}"] * bool(least)
        expected = f"{name} {source}, within {' or '.join(limits)}"
        raise Missed(expected, f"{value:.3g} {unit}", hint, about=(value, truth, *about) if about else ())


def _near(value: float, other: float, part: float) -> bool:
    return abs(value - other) <= part * abs(other)


def _comes_down_in_steps(drive: Drive) -> bool:
    """Whether each command of 0 comes after one that is slower than half the fastest."""
    sizes = [abs(speed) for _, speed in drive.commands]
    before = [last for last, size in itertools.pairwise(sizes) if last and not size]
    return bool(before) and max(before) < 0.5 * max(sizes)


if __name__ == "__main__":
    score = lab_score(sys.argv[1], json.loads(Path(sys.argv[2]).read_text(encoding="utf-8")))
    for verdict in score.verdicts:
        print(f"{verdict.status:8}{verdict.sentence}")
        if verdict.status == "failed":
            print(f"        Expected {verdict.expected}; saw {verdict.saw}. {verdict.hint}")
    print(f"{float(score):g} of {score.max:g} points")
