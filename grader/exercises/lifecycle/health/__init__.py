"""Diagnostics: a program that reports how the robot is, so that others can act on it."""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from grader.checks import Missed, publishes, subscribes
from grader.checks import rate as keeps_rate
from grader.exercise import Exercise
from grader.exercises.lifecycle.health.battery_and_motor import BATTERY, MOTOR, BatteryAndMotor
from grader.geometry.near import is_near
from grader.responses import from_course, last_before
from grader.variants import Variants
from sim.evidence import Message, Recording, Seconds, since_start

__all__ = ["BatteryAndMotor", "health"]

TOPIC, TYPE = "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"
OK, WARN, ERROR, STALE = range(4)
WORDS = ("OK", "WARN", "ERROR", "STALE")
LEVELS: dict[str, Callable[[float], int]] = {
    "battery": lambda percent: ERROR if percent < 10 else WARN if percent < 30 else OK,
    "motor": lambda celsius: ERROR if celsius >= 80 else WARN if celsius >= 60 else OK,
}
YOUNG, OLD, STEADY, NOW = 0.85, 1.15, 0.25, 0.1  # s
EXACT = 0.51  # of a percent, of a degree

health = Exercise("health", "How are you?", seconds=13, companions=[BatteryAndMotor], seeds=(1, 2),
                  variants=Variants(
    {"percent": ("percent", "charge")},  # keys of the values
    {"celsius": ("celsius", "temperature")},
    texts=("`{percent}`", '"{percent}"', "`{celsius}`", '"{celsius}"'),
))


class PartReport(NamedTuple):
    """A report on one part, and the truth: None where it is about to change."""

    stamp: Seconds
    name: str
    level: int
    true: int | None
    value: str | None
    number: float
    age: Seconds


@health.check(3)
def reports(run: Recording) -> None:
    """Once a second a DiagnosticArray is on /diagnostics, with a status `battery` and a status `motor`."""
    subscribes(run, BATTERY, "sensor_msgs/msg/BatteryState")
    subscribes(run, MOTOR, "sensor_msgs/msg/Temperature")
    arrays = publishes(run, TOPIC, TYPE, at_least=3)
    for row in arrays:
        names = sorted(status.name for status in row.message.status)
        if names != ["battery", "motor"]:
            hint = "Each DiagnosticStatus has a name: battery for the one, motor for the other."
            if len(names) < 2:
                hint = "Put both in one array: msg.status = [battery, motor]."
            raise Missed("the statuses battery and motor", ", ".join(names) or "none", hint)
    keeps_rate(run, TOPIC, 1.0)


@health.check(6, after=reports)
def knows_the_level(run: Recording) -> None:
    """The level of each is OK, WARN or ERROR, according to its last value."""
    _compare([one for one in _reports(run) if one.true not in (None, STALE)])


@health.check(4, after=knows_the_level)
def knows_what_is_stale(run: Recording) -> None:
    """A part that has been silent for over 1 s is STALE; nothing else is."""
    _compare([one for one in _reports(run) if one.true == STALE])


@health.check(3, after=knows_the_level)
def gives_the_number(run: Recording) -> None:
    """The values contain the last reading: `percent` for the battery (0 to 100), `celsius` for the motor."""
    for one in _reports(run):
        if one.true in (None, STALE):
            continue
        key = _key(one.name)
        if not is_near(_number(one.value), one.number, EXACT):
            saw = "no such key" if one.value is None else repr(one.value)
            expected = f"{key} {one.number:.3g} in the values of {one.name} at {one.stamp:.3g} s"
            raise Missed(expected, saw, _value_hint(one))


@health.check(2, after=knows_the_level)
def stamps_it(run: Recording) -> None:
    """The header of each array is stamped with the time at which it was made."""
    for row in publishes(run, TOPIC):
        stamp = since_start(row.message.header.stamp)
        if not is_near(row.stamp, stamp, NOW):
            saw = "an empty stamp" if row.message.header.stamp.sec == 0 else f"{stamp:.3g} s"
            hint = "msg.header.stamp = self.get_clock().now().to_msg()"
            raise Missed(f"{row.stamp:.3g} s in header.stamp", saw, hint)


def _reports(run: Recording) -> Iterator[PartReport]:
    parts = {"battery": from_course(run, BATTERY, at_least=5), "motor": from_course(run, MOTOR, at_least=5)}
    for row in publishes(run, TOPIC, TYPE):
        for status in row.message.status:
            now, known = row.stamp, parts.get(status.name, [])
            newest, before = last_before(known, now), last_before(known, now - STEADY)
            if newest is None:
                continue  # it has just begun
            number, age = _measured(newest), now - newest.stamp
            changes = before is not None and _measured(before) != number and age < STEADY
            true = STALE if age > OLD else None if changes or age > YOUNG else LEVELS[status.name](number)
            value = next((pair.value for pair in status.values if pair.key == _key(status.name)), None)
            level = int.from_bytes(status.level, "little")
            yield PartReport(now, status.name, level, true, value, number, age)


def _key(name: str) -> str:
    """Return the key under which a part's number is."""
    return str(health.drawn.percent if name == "battery" else health.drawn.celsius)


def _measured(row: Message) -> float:
    """In percent, or in degrees."""
    message = row.message
    return float(message.percentage * 100 if hasattr(message, "percentage") else message.temperature)


def _compare(reports: list[PartReport]) -> None:
    """Raises Missed at the first report that is wrong, and where there is none."""
    if not reports:
        raise Missed("reports in each state", "none in this one")
    for one in reports:
        if one.true is not None and one.level != one.true:
            state = f"{one.number:.3g} {'%' if one.name == 'battery' else 'degrees'}"
            if one.true == STALE:
                state = f"nothing for {one.age:.2g} s"
            expected = f"{WORDS[one.true]} for {one.name} at {one.stamp:.3g} s: {state}"
            saw = WORDS[one.level] if one.level < len(WORDS) else f"level {one.level}"
            raise Missed(expected, saw, _level_hint(one))


def _level_hint(one: PartReport) -> str:
    if one.true == STALE:
        return "The last value is out of date: store when it arrived, and check how long ago that was."
    if one.level == STALE and one.number == 0.0:
        return ("0 is a number, too: ask whether there is one, `name in self.numbers`, and not whether it is "
                "true.")
    if one.level == STALE:
        return ("New messages did arrive: store the time of the last one, in seconds, separately for each "
                "part.")
    if one.number != round(one.number) and LEVELS[one.name](round(one.number)) == one.level:
        return "Compare the number as it came. To round is for the text, and comes after that."
    if one.name == "battery":
        return ("percentage goes from 0 to 1. Below 0.3 it is WARN, below 0.1 ERROR: test for the worse one "
                "first.")
    return "From 60 degrees on it is WARN, from 80 on ERROR, both with >=. Ask for the worse one first."


def _number(text: str | None) -> float:
    try:
        return float(text or "nan")
    except ValueError:
        return math.nan


def _value_hint(one: PartReport) -> str:
    if one.value is None:
        keys = f'with the keys "{_key("battery")}" and "{_key("motor")}".'
        return f"status.values = [KeyValue(key=..., value=...)], {keys}"
    if one.name == "battery" and is_near(_number(one.value) * 100, one.number, EXACT):
        return "That is not in percent: publish 100 times the percentage of the BatteryState."
    return "A KeyValue's value is a string: use str(...) of the number alone, without a unit."
