"""An exercise on the end of a goal that nobody wants any more."""

from __future__ import annotations

from grader.checks import Missed, check
from grader.exercise import Exercise
from grader.exercises.actions.evidence import (
    FIBONACCI,
    FIBONACCI_TYPE,
    ended,
    named,
    offered,
    picked,
    sequence,
    state,
)
from grader.exercises.actions.partners import Impatient
from grader.exercises.actions.serving import OFFER, SUCCEED
from grader.exercises.advice import advising
from sim.exchanges import CANCEL_REQUESTED, Goal
from sim.recording import Recording, Seconds

QUICKLY = 1.0  # seconds from the wish to the end
NOBODY = "The first goal is never executed: is main() complete? It ends with executor.spin()."


def _long(recording: Recording) -> tuple[Goal, Seconds]:
    """The goal that is to be canceled, and when."""
    goal = picked(recording, FIBONACCI)[0]
    asked, end = goal.at(CANCEL_REQUESTED), ended(goal)
    if asked is None or (end is not None and end < asked):
        with advising(recording, NOBODY if not goal.over else "Let execute wait 0.5 s for each number."):
            saw = f"{state(goal)}, before anybody could cancel it"
            raise Missed(f"{named(goal)} executed, with 0.5 s for each number", saw)
    return goal, asked


@check(points=2)
def still_offers(recording: Recording) -> None:
    """The node offers the action /fibonacci of type Fibonacci."""
    offered(recording, FIBONACCI, FIBONACCI_TYPE, OFFER)


@check(points=5, after=still_offers)
def hears_the_cancel(recording: Recording) -> None:
    """The wish to cancel is heard and agreed to at once, while the goal is executed."""
    goal, asked = _long(recording)
    heard = goal.at("canceling")
    if heard is None or heard > asked + 0.1:
        saw = "it never agreed" if heard is None else f"heard at {heard:.3g} s"
        with advising(recording, "It takes cancel_callback=self.hear_cancel, and an executor with threads."):
            raise Missed(f"the wish of {asked:.3g} s to cancel agreed to at once", f"{saw}; {state(goal)}")


@check(points=4, after=hears_the_cancel)
def stops_soon(recording: Recording) -> None:
    """The goal ends within a second, as canceled."""
    goal, asked = _long(recording)
    end = ended(goal)
    if goal.status != "canceled" or end is None or end - asked > QUICKLY:
        hint = "In the loop: if goal_handle.is_cancel_requested, call goal_handle.canceled() and return."
        if goal.status == "canceled":
            hint = "Look at goal_handle.is_cancel_requested before each number, not only now and then."
        with advising(recording, hint):
            raise Missed(f"{named(goal)} canceled within {QUICKLY:g} s of {asked:.3g} s", state(goal))


@check(points=2, after=stops_soon)
def tells_how_far_it_came(recording: Recording) -> None:
    """The result of the canceled goal holds the numbers found so far."""
    goal, asked = _long(recording)
    numbers = list(goal.result.sequence) if goal.result is not None else []
    told = [list(heard.message.sequence) for heard in goal.feedback]
    begun = sequence(len(numbers) - 1) if numbers else []
    if not numbers or numbers != begun or len(numbers) < len(told[-1] if told else []):
        hint = "After canceled(): return Fibonacci.Result(sequence=sequence), with what it has so far."
        wanted = told[-1] if told else sequence(int(asked))
        raise Missed(f"{wanted} as the result of {named(goal)}", f"{numbers}", hint)


@check(points=2, after=still_offers)
def finishes_the_others(recording: Recording) -> None:
    """A goal that nobody cancels still succeeds, with the whole sequence."""
    for goal in picked(recording, FIBONACCI, lambda goal: goal.request.order < 20):
        if goal.status != "succeeded":
            with advising(recording, SUCCEED):
                raise Missed(f"{named(goal)} succeeded", state(goal))
        if goal.result is None or list(goal.result.sequence) != sequence(goal.request.order):
            saw = "no result" if goal.result is None else f"{list(goal.result.sequence)}"
            raise Missed(f"{sequence(goal.request.order)} as the result of {named(goal)}", saw)


stoppable = Exercise(
    "stoppable",
    "A server that can be stopped",
    [still_offers, hears_the_cancel, stops_soon, tells_how_far_it_came, finishes_the_others],
    seconds=18,
    companions=[Impatient],
    seeds=(1, 2),
)
