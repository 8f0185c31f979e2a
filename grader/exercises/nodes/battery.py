"""A battery that warns: log levels."""

from grader.checks import LogMatch, Missed, come_every, hinting, logs
from grader.checks.fields import listed
from grader.checks.logs import FLOOD
from grader.exercise import Exercise
from grader.variants import Variants
from sim.evidence import Recording

battery = Exercise("battery", "A battery that warns", seconds=12, variants=Variants(
    {"warning": (30, 40)},
    {"alarm": (10, 20)},
    texts=("{warning} %", "charge > {warning}", "charge > {alarm}", "above {alarm} %", "at {alarm} %",
           "At {alarm} %", "exactly {alarm} %", "and {alarm} % belong"),
))


@battery.check(3, lasts=True)
def reports_the_charge(run: Recording) -> list[LogMatch]:
    """A line comes every second, from “Battery: 90 %” down to “Battery: 0 %”."""
    lines = logs(run, r"^\W*?battery\W+(\d+)", example="Battery: 90 %")
    found = [_charge(line) for line in lines]
    wanted = [max(0, 90 - 10 * index) for index in range(max(len(found), 10))]
    if found != wanted[: len(found)]:
        hint = "Log one line for each measurement, at one level: use if, elif, else."
        credit = 0.5 if len(found) <= FLOOD * run.seconds else 0.0
        raise Missed(listed(wanted), listed(found), hint, credit=credit, measured=lines)
    return come_every(run, lines, 1.0, credit=0.5)


@battery.check(3, after=reports_the_charge)
def informs(run: Recording, lines: list[LogMatch]) -> None:
    """Above 30 % the line is at info level."""
    _have_level(run, lines, range(battery.drawn.warning + 10, 91, 10), "INFO")


@battery.check(3, after=reports_the_charge)
def warns(run: Recording, lines: list[LogMatch]) -> None:
    """From 30 % down to above 10 % it is a warning."""
    limits = battery.drawn
    _have_level(run, lines, range(limits.alarm + 10, limits.warning + 1, 10), "WARN")


@battery.check(3, after=reports_the_charge)
def alarms(run: Recording, lines: list[LogMatch]) -> None:
    """At 10 % and below it is an error."""
    _have_level(run, lines, range(0, battery.drawn.alarm + 1, 10), "ERROR")


def _have_level(run: Recording, lines: list[LogMatch], charges: range, level: str) -> None:
    """The lines about these charges have the level. Raises Missed for the first without."""
    about = [line for line in lines if _charge(line) in charges]
    wrong = [line for line in about if line.level != level]
    if not about:
        hint = "Look at your last case: else."
        if run.ended.stamp - lines[-1].stamp < 2 * (lines[-1].stamp - lines[-2].stamp if lines[1:] else 1.0):
            hint = "The run ended before the charge dropped that far: log one line every second first."
        raise Missed(f"lines from {charges[-1]} % to {charges[0]} %", "none", hint)
    if wrong:
        edges = {charges[0], charges[-1]}
        at_the_edge = {_charge(line) for line in wrong} <= edges and len(wrong) < len(about)
        question = "> or >=?" if at_the_edge else "which branch does it take?"
        hint = f"Follow your comparisons for {_charge(wrong[0])} %, one after the other: {question}"
        expected, saw = f"“{wrong[0].text}” at level {level}", f"it at level {wrong[0].level}"
        raise Missed(expected, saw, hint, credit=1 - len(wrong) / len(about))


def _charge(line: LogMatch) -> int:
    return int(line.groups[0])


@battery.check(3, lasts=True)
def shows_debug_lines(run: Recording) -> None:
    """A debug line “Measuring” is logged every second."""
    with hinting("Debug lines are hidden until the logger's level is set to DEBUG." if run.logs else ""):
        lines = logs(run, r"^\W*?measuring", level="DEBUG", example="Measuring")
    come_every(run, lines, 1.0)
