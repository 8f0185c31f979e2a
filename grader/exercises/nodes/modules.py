"""A weather station whose conversions live in a module of the student's own."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.checks import Missed, check, named
from grader.exercise import Exercise
from grader.exercises.nodes.lines import Found, come_every, in_words, lines_like
from sim.recording import LogLine, Recording

READINGS = (-8, -1, 0, 12, 29, 30, 35)  # °C, as the notebook gives them
LINE = r"(-?\d+(?:\.\d+)?)\W*C\W+?(-?\d+(?:\.\d+)?)\W*F\W+(\w+)"
EXAMPLE = "12 C = 53.6 F, mild"


def _lines(recording: Recording) -> list[Found]:
    return lines_like(recording, LINE, EXAMPLE)


def _word(celsius: float) -> str:
    return "frost" if celsius < 0 else "mild" if celsius < 30 else "hot"


def _share(recording: Recording, wanted: Callable[[LogLine, re.Match], str], saw: str, hint: str) -> float:
    """The part of the lines that is right. Raises Missed for the first that isn't.

    wanted: says what is wrong with a line, "" if nothing is. saw: what to show of the line.
    """
    found = [(line, wanted(line, match)) for line, match in _lines(recording)]
    wrong = [(line, expected) for line, expected in found if expected]
    if wrong:
        line, expected = wrong[0]
        raise Missed(expected, saw.format(line=line), hint, credit=1 - len(wrong) / len(found))
    return 1.0


@check(points=2)
def called_weather(recording: Recording) -> None:
    """The node is called weather."""
    named(recording, "/weather")


@check(points=3)
def tells_the_weather(recording: Recording) -> None:
    """A line like “12 C = 53.6 F, mild” comes every second."""
    come_every(recording, [line for line, _ in _lines(recording)], 1.0, credit=0.25)


@check(points=3, after=tells_the_weather)
def takes_readings_in_turn(recording: Recording) -> None:
    """The readings come in their order, and after the last one the first again."""
    found = [round(float(match[1])) for _, match in _lines(recording)]
    wanted = [READINGS[index % len(READINGS)] for index in range(max(len(found), len(READINGS) + 1))]
    if found != wanted[: len(found)] or len(found) < len(wanted):
        hint = "Keep the number of the next reading in self; index % len(READINGS) goes round in a circle."
        first_round = found[: len(READINGS)] == list(READINGS)
        raise Missed(in_words(wanted), in_words(found), hint, credit=0.5 * first_round)


@check(points=4, after=tells_the_weather)
def converts(recording: Recording) -> float:
    """The degrees Fahrenheit are right, to one decimal."""

    def wanted(_: LogLine, match: re.Match) -> str:
        celsius, fahrenheit = float(match[1]), float(match[1]) * 9 / 5 + 32
        return "" if abs(float(match[2]) - fahrenheit) < 0.051 else f"{celsius:g} C = {fahrenheit:.1f} F"

    hint = "Try your function in a cell: 0 °C are 32 °F, and 100 °C are 212 °F."
    return _share(recording, wanted, "“{line.text}”", hint)


@check(points=4, after=tells_the_weather)
def describes(recording: Recording) -> float:
    """The words are right: frost below 0 °C, hot from 30 °C on, else mild."""

    def wanted(_: LogLine, match: re.Match) -> str:
        word = _word(float(match[1]))
        return "" if match[3].lower() == word else f"{match[1]} C to be {word}"

    hint = "Try your function in a cell, at the edges above all: -1, 0, 29 and 30."
    return _share(recording, wanted, "“{line.text}”", hint)


@check(points=4, after=tells_the_weather)
def warns_of_frost_and_heat(recording: Recording) -> float:
    """Frost and hot are warnings, mild is information."""

    def wanted(line: LogLine, match: re.Match) -> str:
        level = "INFO" if match[3].lower() == "mild" else "WARN"
        return "" if line.level == level else f"“{line.text}” at level {level}"

    hint = "Use warning(...) for frost and hot, and info(...) for mild."
    return _share(recording, wanted, "it at level {line.level}", hint)


weather = Exercise(
    "weather",
    "A weather station with a module of its own",
    [
        called_weather,
        tells_the_weather,
        takes_readings_in_turn,
        converts,
        describes,
        warns_of_frost_and_heat,
    ],
    seconds=10,
)
