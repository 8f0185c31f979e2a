"""A weather station whose conversions live in a module of the student's own."""

import math

from grader.checks import LogMatch, Missed, come_every, logs, named
from grader.checks.fields import listed
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Recording

weather = Exercise("weather", "A weather station with a module of its own", seconds=10, variants=Variants(
    {"hot": (30, 25, 28), "below": (29, 24, 27)},
    {"word": ("mild", "fair")},
    texts=("{word}", "at {hot} and above", "celsius >= {hot}", "12, {below}, {hot}, 35", "exactly {hot} °C",
           "from {hot} °C"),
))
LINE = r"^\W*?(-?\d+(?:\.\d+)?)\W*C\W+?(-?\d+(?:\.\d+)?)\W*F\W+(\w+)"


@weather.check(2)
def called_weather(run: Recording) -> None:
    """The node is called weather."""
    named(run, "/weather")


@weather.check(3, lasts=True)
def logs_the_weather(run: Recording) -> list[LogMatch]:
    """A line like “12 C = 53.6 F, mild” comes every second."""
    example = f"12 C = 53.6 F, {weather.drawn.word}"
    return come_every(run, logs(run, LINE, example=example), 1.0, credit=0.25)


@weather.check(3, after=logs_the_weather)
def takes_readings_in_turn(run: Recording, lines: list[LogMatch]) -> None:
    """The readings come in order, and start over after the last one."""
    values, readings = map(_celsius, lines), _readings()
    found = [round(value) if math.isfinite(value) else value for value in values]
    wanted = [readings[index % len(readings)] for index in range(max(len(found), len(readings) + 1))]
    if found != wanted[: len(found)] or len(found) < len(wanted):
        hint = "Store the index of the next reading in self; index % len(READINGS) wraps around to 0."
        first_round = found[: len(readings)] == readings
        raise Missed(listed(wanted), listed(found), hint, credit=0.5 * first_round)


@weather.check(4, after=logs_the_weather)
def converts(run: Recording, lines: list[LogMatch]) -> None:
    """The temperature in Fahrenheit is right, to one decimal place."""
    wrong = [line for line in lines if not is_near(float(line.groups[1]), _fahrenheit(line), 0.051)]
    if wrong:
        expected = f"{_celsius(wrong[0]):g} C = {_fahrenheit(wrong[0]):.1f} F"
        hint = "Try your function in a cell: 0 °C is 32 °F, and 100 °C is 212 °F."
        raise Missed(expected, f"“{wrong[0].text}”", hint, credit=1 - len(wrong) / len(lines))


@weather.check(4, after=logs_the_weather)
def describes(run: Recording, lines: list[LogMatch]) -> None:
    """The words are right: frost below 0 °C, hot from 30 °C on, otherwise mild."""
    wrong = [line for line in lines if line.groups[2].lower() != _word(line)]
    if wrong:
        expected = f"{wrong[0].groups[0]} C to be {_word(wrong[0])}"
        limits = weather.drawn
        edges = f"-1, 0, {limits.below} and {limits.hot}"
        hint = f"Try your function in a cell, especially at the edges: {edges}."
        raise Missed(expected, f"“{wrong[0].text}”", hint, credit=1 - len(wrong) / len(lines))


@weather.check(4, after=logs_the_weather)
def warns_of_frost_and_heat(run: Recording, lines: list[LogMatch]) -> None:
    """Frost and hot are logged as warnings, mild as info."""
    wrong = [line for line in lines if line.level != _level(line)]
    if wrong:
        expected, saw = f"“{wrong[0].text}” at level {_level(wrong[0])}", f"it at level {wrong[0].level}"
        hint = f"Use warning(...) for frost and hot, and info(...) for {weather.drawn.word}."
        raise Missed(expected, saw, hint, credit=1 - len(wrong) / len(lines))


def _readings() -> list[int]:
    """Return the readings in °C, as the notebook gives them."""
    return [-8, -1, 0, 12, weather.drawn.below, weather.drawn.hot, 35]


def _celsius(line: LogMatch) -> float:
    return float(line.groups[0])


def _fahrenheit(line: LogMatch) -> float:
    return _celsius(line) * 9 / 5 + 32


def _word(line: LogMatch) -> str:
    limits = weather.drawn
    return "frost" if _celsius(line) < 0 else limits.word if _celsius(line) < limits.hot else "hot"


def _level(line: LogMatch) -> str:
    return "INFO" if line.groups[2].lower() == weather.drawn.word else "WARN"
