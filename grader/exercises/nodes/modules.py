"""A weather station whose conversions live in a module of the student's own."""

from __future__ import annotations

from collections.abc import Callable

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.nodes.lines import Found, come_every, in_words, lines_like
from sim.recording import Recording

READINGS = (-8, -1, 0, 12, 29, 30, 35)  # °C, as the notebook gives them
LINE = r"(-?\d+(?:\.\d+)?)\W*C\W+?(-?\d+(?:\.\d+)?)\W*F\W+(\w+)"
EXAMPLE = "12 C = 53.6 F, mild"


def _lines(recording: Recording) -> list[Found]:
    return lines_like(recording, LINE, EXAMPLE)


def _word(celsius: float) -> str:
    return "frost" if celsius < 0 else "mild" if celsius < 30 else "hot"


def _share(recording: Recording, is_right: Callable[[Found], bool], expected: Callable, hint: str) -> float:
    """The part of the lines that is right. Raises Missed for the first that isn't."""
    lines = _lines(recording)
    wrong = [found for found in lines if not is_right(found)]
    if wrong:
        line, match = wrong[0]
        saw = f"“{line.text}” at level {line.level}"
        raise Missed(expected(float(match[1])), saw, hint, credit=1 - len(wrong) / len(lines))
    return 1.0


@check(points=4)
def tells_the_weather(recording: Recording) -> None:
    """A line like “12 C = 53.6 F, mild” comes every second."""
    come_every(recording, [line for line, _ in _lines(recording)], 1.0)


@check(points=4, after=tells_the_weather)
def takes_readings_in_turn(recording: Recording) -> None:
    """The readings come in their order, and after the last one the first again."""
    found = [round(float(match[1])) for _, match in _lines(recording)]
    wanted = [READINGS[index % len(READINGS)] for index in range(len(found))]
    if found != wanted:
        right = next(i for i, pair in enumerate(zip(found, wanted, strict=True)) if pair[0] != pair[1])
        hint = "Keep the number of the next reading in self; index % len(READINGS) goes round in a circle."
        raise Missed(in_words(wanted), in_words(found), hint, credit=0.5 * (right >= len(READINGS)))


@check(points=4, after=tells_the_weather)
def converts(recording: Recording) -> float:
    """The degrees Fahrenheit are right, to one decimal."""
    return _share(
        recording,
        lambda found: abs(float(found[1][2]) - (float(found[1][1]) * 9 / 5 + 32)) < 0.051,
        lambda celsius: f"{celsius:g} C = {celsius * 9 / 5 + 32:.1f} F",
        "Try your function in a cell: 0 °C are 32 °F, and 100 °C are 212 °F.",
    )


@check(points=4, after=tells_the_weather)
def describes(recording: Recording) -> float:
    """The words are right: frost below 0 °C, hot from 30 °C on, else mild."""
    return _share(
        recording,
        lambda found: found[1][3].lower() == _word(float(found[1][1])),
        lambda celsius: f"{celsius:g} C to be {_word(celsius)}",
        "Try your function in a cell, at the edges above all: -1, 0, 29 and 30.",
    )


@check(points=4, after=tells_the_weather)
def warns_of_frost_and_heat(recording: Recording) -> float:
    """Frost and heat are warnings, mild weather is information."""
    levels = {"mild": "INFO", "frost": "WARN", "hot": "WARN"}
    return _share(
        recording,
        lambda found: found[0].level == levels[_word(float(found[1][1]))],
        lambda celsius: f"the line on {celsius:g} C at level {levels[_word(celsius)]}",
        "Use warning(...) for frost and hot, and info(...) for mild.",
    )


weather = Exercise(
    "weather",
    "A weather station with a module of its own",
    [tells_the_weather, takes_readings_in_turn, converts, describes, warns_of_frost_and_heat],
    seconds=10,
)
