"""A battery that warns: log levels."""

from __future__ import annotations

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.nodes.lines import come_every, in_words, lines_like
from sim.recording import LogLine, Recording


def _charges(recording: Recording) -> list[tuple[int, LogLine]]:
    lines = lines_like(recording, r"battery\W+(\d+)", "Battery: 90 %")
    return [(int(found[1]), line) for line, found in lines]


def _has_level(recording: Recording, charges: range, level: str) -> float:
    """The part of the lines about these charges that have the level. Raises Missed for the first without."""
    ours = [(charge, line) for charge, line in _charges(recording) if charge in charges]
    wrong = [(charge, line) for charge, line in ours if line.level != level]
    if not ours:
        raise Missed(f"lines from {charges[-1]} % to {charges[0]} %", "none", "Look at your last case: else.")
    if wrong:
        charge, line = wrong[0]
        edges = {charges[0], charges[-1]}
        at_the_edge = {charge for charge, _ in wrong} <= edges and len(wrong) < len(ours)
        question = "> or >=?" if at_the_edge else "where do they lead?"
        hint = f"Follow your comparisons for {charge} %, one after the other: {question}"
        expected, saw = f"“{line.text}” at level {level}", f"it at level {line.level}"
        raise Missed(expected, saw, hint, credit=1 - len(wrong) / len(ours))
    return 1.0


@check(points=3)
def reports_the_charge(recording: Recording) -> None:
    """A line comes every second, from “Battery: 90 %” down to “Battery: 0 %”."""
    lines = _charges(recording)
    found = [charge for charge, _ in lines]
    wanted = [max(0, 90 - 10 * index) for index in range(max(len(found), 10))]
    if found != wanted[: len(found)]:
        hint = "One line for each measurement, at one level: if, elif, else."
        raise Missed(in_words(wanted), in_words(found), hint, credit=0.5)
    come_every(recording, [line for _, line in lines], 1.0, credit=0.5)


@check(points=3, after=reports_the_charge)
def informs(recording: Recording) -> float:
    """Above 30 % the line is at info level."""
    return _has_level(recording, range(40, 91, 10), "INFO")


@check(points=3, after=reports_the_charge)
def warns(recording: Recording) -> float:
    """From 30 % down to above 10 % it is a warning."""
    return _has_level(recording, range(20, 31, 10), "WARN")


@check(points=3, after=reports_the_charge)
def alarms(recording: Recording) -> float:
    """At 10 % and below it is an error."""
    return _has_level(recording, range(0, 11, 10), "ERROR")


@check(points=3)
def shows_debug_lines(recording: Recording) -> None:
    """A debug line “Measuring” can be seen every second."""
    hint = "Debug lines are hidden until the logger's level is set to DEBUG."
    lines = lines_like(recording, "measuring", "Measuring", level="DEBUG", hint=hint)
    come_every(recording, [line for line, _ in lines], 1.0)


battery = Exercise(
    "battery",
    "A battery that warns",
    [reports_the_charge, informs, warns, alarms, shows_debug_lines],
    seconds=12,
)
