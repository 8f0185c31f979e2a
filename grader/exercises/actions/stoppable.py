"""An action server whose goals can be canceled."""

from grader.checks import Missed
from grader.checks.actions import state
from grader.companions.goal_senders import Impatient
from grader.exercise import Exercise
from grader.responses.course_goals import (
    FIBONACCI,
    fibonacci_offered,
    goal_text,
    is_succeeded,
    picked,
    sequence,
)
from sim.evidence import CANCEL_REQUESTED, Goal, Recording, Seconds

QUICKLY = 1.0  # seconds from the cancel request to the end

stoppable = Exercise("stoppable", "A server that can be stopped", seconds=18, companions=[Impatient],
                     seeds=(1, 2))


@stoppable.check(2)
def still_offers(run: Recording) -> list[Goal]:
    """The node offers the action /fibonacci of type Fibonacci."""
    return fibonacci_offered(run)


@stoppable.check(5, after=still_offers)
def accepts_the_cancel(run: Recording, goals: list[Goal]) -> tuple[Goal, Seconds]:
    """The cancel request is received and accepted at once, while the goal is executed."""
    goal = goals[0]
    requested, accepted = goal.at(CANCEL_REQUESTED), goal.at("canceling")
    if requested is None or (goal.ended is not None and goal.ended < requested):
        guess = "Make execute wait 0.5 s for each number." if goal.over else ""
        saw = f"{state(goal) if goal.server else 'no decision on it'}, before it could be canceled"
        raise Missed(f"{goal_text(goal)} executed, with 0.5 s for each number", saw, guess=guess)
    if accepted is None or accepted > requested + 0.1:
        saw = "it was never accepted" if accepted is None else f"accepted at {accepted:.3g} s"
        raise Missed(f"the cancel request at {requested:.3g} s accepted at once", f"{saw}; {state(goal)}")
    return goal, requested


@stoppable.check(4, after=accepts_the_cancel)
def stops_soon(run: Recording, canceled: tuple[Goal, Seconds]) -> Goal:
    """The goal ends within a second, as canceled."""
    goal, requested = canceled
    if goal.status != "canceled" or goal.ended is None or goal.ended - requested > QUICKLY:
        often = "Check goal_handle.is_cancel_requested before every number, not just now and then."
        ending = "If goal_handle.is_cancel_requested, call goal_handle.canceled() and return the result."
        guess = often if goal.status == "canceled" else ending
        expected = f"{goal_text(goal)} canceled within {QUICKLY:g} s of {requested:.3g} s"
        raise Missed(expected, state(goal), guess=guess)
    return goal


@stoppable.check(2, after=stops_soon)
def returns_what_it_has(run: Recording, goal: Goal) -> None:
    """The result of the canceled goal contains the numbers computed so far."""
    numbers = list(goal.result.sequence) if goal.result is not None else []
    sent = list(goal.feedback[-1].message.sequence) if goal.feedback else []
    if not numbers or numbers != sequence(len(numbers) - 1) or len(numbers) < len(sent):
        hint = "After canceled(): return Fibonacci.Result(sequence=sequence), with the numbers so far."
        wanted = sent or sequence(int(goal.at(CANCEL_REQUESTED) or 0.0))
        raise Missed(f"{wanted} as the result of {goal_text(goal)}", f"{numbers}", hint)


@stoppable.check(2, after=still_offers)
def finishes_the_others(run: Recording) -> None:
    """A goal that isn't canceled still succeeds, with the whole sequence."""
    for goal in picked(run, FIBONACCI, lambda goal: goal.request.order < 20):
        is_succeeded(goal)
        wanted = sequence(goal.request.order)
        if goal.result is None or list(goal.result.sequence) != wanted:
            saw = "no result" if goal.result is None else f"{list(goal.result.sequence)}"
            raise Missed(f"{wanted} as the result of {goal_text(goal)}", saw)
