"""Six small systems: which are right in every order, which order breaks the others, and a repair of each."""

from collections.abc import Iterator, Mapping
from typing import Any

from grader.checks import Missed, publishes
from grader.exercise import Exercise
from grader.exercises.systems.audit.audited import audited
from grader.exercises.systems.audit.changed_lines import changed_lines
from grader.exercises.systems.audit.delays import TICK, read_delays
from grader.exercises.systems.audit.deliveries import (
    ANSWERS,
    BEGIN,
    LASTS,
    PLAYS,
    deliveries,
    question_of,
    read_answers,
    trials,
)
from grader.exercises.systems.audit.promises import broken_promise
from grader.exercises.systems.audit.six_systems import (
    SYSTEMS,
    Collector,
    Dock,
    JobStarter,
    Labeler,
    Rider,
    SpeedGate,
)
from sim.evidence import Recording

__all__ = ["Collector", "Dock", "JobStarter", "Labeler", "Rider", "SpeedGate", "audit", "audited",
           "deliveries", "trials"]  # fmt: skip

Answers = dict[str, dict[str, Any]]

RACY, MOST_LINES = ("labeler", "dock", "collector", "rider"), 6
HINTS = {
    "labeler": "What is stored for one parcel must not be taken for another: store it under the parcel's "
               "number.",
    "dock": "Between the check and the moment at which it becomes true, another callback checks the same. "
            "When does the dock stop being free for the next robot?",
    "collector": "A path is complete when its size and its last point are there, whichever is last. So "
                 "both callbacks have to look whether it is.",
    "rider": "The doors can open before the response says which lift it is: remember what opened since the "
             "ride began, and look at it when the response comes.",
}  # fmt: skip

audit = Exercise("audit", "Which order breaks it?", seconds=(BEGIN + LASTS * PLAYS) * TICK + 0.1,
                 companions=trials, seeds=(1, 2))  # fmt: skip


@audit.check(1)
def answers_all(run: Recording) -> Answers:
    """There is an answer for each of the six systems: None, or delays and a class."""
    publishes(run, ANSWERS, "std_msgs/msg/String")
    found: Answers = {}
    for row in run.messages(ANSWERS):
        found = found or read_answers(row.message.data, question_of(run.seed))
    for name in SYSTEMS:
        if name not in found:
            hint = f"answers() returns a dictionary with the keys {', '.join(SYSTEMS)}."
            raise Missed(f"an answer for {name}", "none", hint)
        if "problem" in found[name]:
            hint = "A system with a race gets a pair: its delays, a comma, and the repaired class."
            raise Missed(f"None, or delays and a class, for {name}", str(found[name]["problem"])[:60], hint)
    return found


@audit.check(5, after=answers_all)
def breaks_the_given(run: Recording, found: Answers) -> Answers:
    """The delays break the promise of each of the four systems that have a race, as they were given."""
    return _all_but(found, [miss for name in RACY for miss in _not_broken(run, name, found[name])])


@audit.check(2, after=breaks_the_given)
def spares_the_right(run: Recording, found: Answers) -> None:
    """The two systems that are right in every order get None."""
    for name in SYSTEMS:
        if name not in RACY and found[name] and broken_promise(run, name, 0, given=True) is None:
            hint = ("Your delays don't break it: it keeps its promise. Go through its callbacks in each "
                    "order, and look at what it remembers.")  # fmt: skip
            raise Missed(f"None for {name}: it's right in every order", "delays", hint)


@audit.check(5, after=breaks_the_given)
def repairs_hold(run: Recording, found: Answers) -> Answers:
    """Each repaired system keeps its promise with your delays and in four other orders."""
    return _all_but(found, [miss for name in RACY for miss in _not_repaired(run, name, found[name])])


@audit.check(1, after=repairs_hold)
def repairs_are_small(run: Recording, found: Answers) -> None:
    """No repair changes more than six lines."""
    for name in filter(found.get, RACY):
        try:
            lines = changed_lines(name, _methods(found[name]), found[name].get("inherits") is True)
        except ValueError:
            hint = "Define the class in a cell."
            raise Missed(f"the source of the repaired {name}", "none", hint) from None
        if lines > MOST_LINES:
            hint = "Leave everything that has nothing to do with the race as it is."
            raise Missed(f"at most {MOST_LINES} changed lines in {name}", str(lines), hint)


def _all_but(found: Answers, missed: list[tuple[str, str, str]]) -> Answers:
    """Return the answers if none of the racy systems misses anything; else raise the first miss."""
    if missed:
        raise Missed(*missed[0], credit=1 - len(missed) / len(RACY), measured=found)
    return found


def _methods(answer: Mapping[str, Any]) -> dict[str, str]:
    methods = answer.get("methods")
    if not isinstance(methods, dict) or not all(methods.values()):
        raise ValueError("sources that can't be read")
    return methods


def _not_broken(run: Recording, name: str, answer: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """The miss if a student's delays don't break a given system."""
    expected = f"delays with which {name} breaks its promise"
    if not answer:
        hint = (f"It's right by luck. Try delays with systems.deliveries({name!r}, ...), and look at what it "
                "publishes.")  # fmt: skip
        yield expected, "None", hint
        return
    try:
        read_delays(name, answer.get("delays"))
    except ValueError as error:
        yield expected, str(error), "Take delays that the task allows: no system has to survive others."
        return
    if broken_promise(run, name, 0, given=True) is None:
        hint = ("Which two callbacks come in another order with these delays? Does it matter which of them "
                "is first?")  # fmt: skip
        yield expected, "delays with which it keeps it", hint


def _not_repaired(run: Recording, name: str, answer: Mapping[str, Any]) -> Iterator[tuple[str, str, str]]:
    """The first fault of a student's repaired system."""
    if not answer:
        yield f"a repaired {name}", "None", HINTS[name]
        return
    for number in range(PLAYS):
        broken = broken_promise(run, name, number)
        if broken is not None:
            yield f"{name}: {broken.expected}", broken.saw, broken.hint or HINTS[name]
            return
