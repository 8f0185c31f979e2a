"""An exercise on the end of a goal that nobody wants any more."""

from __future__ import annotations

from grader.checks import Missed
from grader.checks.actions import state
from grader.exercise import Exercise
from grader.exercises.actions.evidence import (
    FIBONACCI,
    FIBONACCI_TYPE,
    is_succeeded,
    named,
    offered,
    picked,
    sequence,
)
from grader.exercises.actions.partners import Impatient
from grader.exercises.actions.serving import OFFER
from sim.evidence import CANCEL_REQUESTED, Goal, Recording, Seconds

QUICKLY = 1.0  # seconds from the wish to the end

stoppable = Exercise(
    "stoppable", "A server that can be stopped", seconds=18, companions=[Impatient], seeds=(1, 2)
)


@stoppable.check(2)
def still_offers(run: Recording) -> list[Goal]:
    """The node offers the action /fibonacci of type Fibonacci."""
    return offered(run, FIBONACCI, FIBONACCI_TYPE, OFFER)


@stoppable.check(
    5,
    after=still_offers,
    guess="It takes cancel_callback=self.hear_cancel, and an executor with threads.",
)
def hears_the_cancel(run: Recording, goals: list[Goal]) -> tuple[Goal, Seconds]:
    """The cancel request is heard and accepted at once, while the goal is executed."""
    goal = goals[0]
    asked, heard = goal.at(CANCEL_REQUESTED), goal.at("canceling")
    if asked is None or (goal.ended is not None and goal.ended < asked):
        guess = "The first goal is never executed: is main() complete? It ends with executor.spin()."
        if goal.over:
            guess = "Let execute wait 0.5 s for each number."
        saw = f"{state(goal) if goal.server else 'no decision on it'}, before anybody could cancel it"
        raise Missed(f"{named(goal)} executed, with 0.5 s for each number", saw, guess=guess)
    if heard is None or heard > asked + 0.1:
        saw = "it never agreed" if heard is None else f"heard at {heard:.3g} s"
        raise Missed(f"the cancel request of {asked:.3g} s accepted at once", f"{saw}; {state(goal)}")
    return goal, asked


@stoppable.check(4, after=hears_the_cancel)
def stops_soon(run: Recording, canceled: tuple[Goal, Seconds]) -> Goal:
    """The goal ends within a second, as canceled."""
    goal, asked = canceled
    if goal.status != "canceled" or goal.ended is None or goal.ended - asked > QUICKLY:
        guess = "In the loop: if goal_handle.is_cancel_requested, call goal_handle.canceled() and return."
        if goal.status == "canceled":
            guess = "Look at goal_handle.is_cancel_requested before each number, not only now and then."
        expected = f"{named(goal)} canceled within {QUICKLY:g} s of {asked:.3g} s"
        raise Missed(expected, state(goal), guess=guess)
    return goal


@stoppable.check(2, after=stops_soon)
def tells_how_far_it_came(run: Recording, goal: Goal) -> None:
    """The result of the canceled goal holds the numbers found so far."""
    numbers = list(goal.result.sequence) if goal.result is not None else []
    told = list(goal.feedback[-1].message.sequence) if goal.feedback else []
    if not numbers or numbers != sequence(len(numbers) - 1) or len(numbers) < len(told):
        hint = "After canceled(): return Fibonacci.Result(sequence=sequence), with what it has so far."
        wanted = told or sequence(int(goal.at(CANCEL_REQUESTED)))
        raise Missed(f"{wanted} as the result of {named(goal)}", f"{numbers}", hint)


@stoppable.check(2, after=still_offers)
def finishes_the_others(run: Recording) -> None:
    """A goal that nobody cancels still succeeds, with the whole sequence."""
    for goal in picked(run, FIBONACCI, lambda goal: goal.request.order < 20):
        is_succeeded(goal)
        wanted = sequence(goal.request.order)
        if goal.result is None or list(goal.result.sequence) != wanted:
            saw = "no result" if goal.result is None else f"{list(goal.result.sequence)}"
            raise Missed(f"{wanted} as the result of {named(goal)}", saw)
