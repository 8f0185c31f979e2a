"""A traceback, read from the bottom: which error ended a program, and in which line of one's own."""

from typing import NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.silence.crash.crash_reports import (
    CRASH,
    HELPER_FILE,
    PAUSE,
    WORKSPACE,
    CrashReport,
    crash_reports,
    crashes,
)  # fmt: skip
from grader.responses import EDGE, Stimuli
from grader.variants import Variants
from sim.evidence import Recording, Seconds

__all__ = ["crash", "crashes"]

STRING = "std_msgs/msg/String"
CAUSE = "/cause"
TOO_MANY = 4  # wrong answers that cost all points of a check
TWO_ERRORS = "There are two tracebacks: the first error was handled, and the last one ended the program."

PLACE = "{path.split('/')[-1]}:{number}"  # in the answer of the notebook

crash = Exercise("crash", "Where did it crash?", seconds=10, companions=crashes, seeds=(1, 2),
                 variants=Variants(
    {"example": ("driver.py:31 TypeError", "TypeError driver.py:31", "TypeError at driver.py:31"),
     "both": ("the **place** and the **error**", *2 * ("the **error** and the **place**",)),
     "parts": ("place and error", *2 * ("error and place",)),
     "between": ("a space", "a space", "` at `"), "sign": (" ", " ", " at "),
     "answer": (f"{PLACE} {{error}}", f"{{error}} {PLACE}", f"{{error}} at {PLACE}"),
     "begins_with": ("place", *2 * ("error",))},
    texts=("{example}", "{both}", "with {between} between", "return {parts}", "{answer}"),
))
texts = Stimuli(CRASH, answered_on=CAUSE, within=PAUSE - 2 * EDGE, what="texts on /crash")


@crash.check(1)
def answers_texts(run: Recording) -> None:
    """The node subscribes to /crash, and publishes String messages on /cause."""
    with hinting("`on_crash`, the callback of /crash, publishes what `cause` returns."):
        subscribes(run, CRASH, STRING)
        publishes(run, CAUSE, STRING)


@crash.check(3, after=answers_texts, hints={
    "Publish one message for each text.": lambda run, one: one.number != 1,
    "A line that begins with “[” is a log line, or one of `ros2 run`: leave such lines out.":
        lambda run, one: one.error.startswith("["),
    TWO_ERRORS: lambda run, one: one.error in one.report.handled,
    "The text of this error has several lines. Its name is in the last line that isn't indented.":
        lambda run, one: not one.error.isidentifier() and one.has_long_text,
    "The error's name is at the beginning of the last line that isn't indented, up to the colon.": otherwise,
})
def names_the_errors(run: Recording) -> None:
    """It names the error that ended the program."""
    answers = _answers(run)
    wrong = [one for one in answers if one.error.rpartition(".")[2] != one.report.error]
    for one in wrong[:1]:
        raise _missed(one, one.report.error, one.error, len(wrong), len(answers))


@crash.check(4, after=answers_texts, hints={
    "Publish one message for each text.": lambda run, one: one.number != 1,
    f"There the error was noticed, and that file isn't yours: go up to the first line in {WORKSPACE}.":
        lambda run, one: one.place == one.report.lowest,
    TWO_ERRORS: lambda run, one: one.place in one.report.handled,
    "A helper of yours, such as shares.py, is yours as well: stop at the first line in the workspace.":
        lambda run, one: one.report.place.startswith(HELPER_FILE) and one.place == one.report.above[-1],
    "That line only led to the one that failed. Read from the bottom up.":
        lambda run, one: one.place in one.report.above,
    "A place is the file's name without its folders, a colon, and the line's number, as in driver.py:31.":
        otherwise,
})
def names_the_lines(run: Recording) -> None:
    """It names the line in the workspace in which that error happened: the lowest one."""
    answers = _answers(run)
    wrong = [one for one in answers if one.place != one.report.place]
    for one in wrong[:1]:
        wanted = f"{one.report.place}, with {one.report.error},"
        raise _missed(one, wanted, one.place, len(wrong), len(answers))


class CrashAnswer(NamedTuple):
    """The answer to a report. number: of messages; the rest is "" if that is not 1."""

    stamp: Seconds
    report: CrashReport
    number: int
    place: str
    error: str

    @property
    def has_long_text(self) -> bool:
        """Return whether the error's own text has several lines."""
        lines = [line for line in self.report.text.splitlines() if not line.startswith("[")]
        return lines[-1].startswith(" ")


def _answers(run: Recording) -> list[CrashAnswer]:
    known = {report.text: report for report in crash_reports(run.seed)}
    found = []
    for text in texts(run):
        values = text.values()
        first, _, second = (values[0] if len(values) == 1 else "").strip().partition(crash.drawn.sign)
        place, error = (first, second) if crash.drawn.begins_with == "place" else (second, first)
        found.append(CrashAnswer(text.stamp, known[text.value.data], len(values), place.strip(),
                                 error.strip()))
    return found


def _missed(one: CrashAnswer, wanted: str, saw: str, wrong: int, of: int) -> Missed:
    """The miss for the first wrong answer of some."""
    saw = f"“{saw[:80]}”" if saw else f"{one.number} messages" if one.number != 1 else "nothing of it"
    saw = f"{saw}; {of - wrong} of {of} are right"
    credit = max(0.0, 1.0 - wrong / TOO_MANY)
    return Missed(f"{wanted} for the text at {one.stamp:.3g} s", saw, credit=credit, about=(one,))
