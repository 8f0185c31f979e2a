"""Exercises on servers: a first one that computes, and one that tells how it is doing and says no."""

from __future__ import annotations

from grader.checks import Missed, rejects
from grader.checks.actions import state
from grader.checks.topics import longest_pause
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
from grader.exercises.actions.partners import Examiner, Mathematician
from sim.evidence import Goal, Recording, stamps

OFFER = 'ActionServer(self, Fibonacci, "/fibonacci", self.execute): node, type, name and callback.'

fibonacci = Exercise("fibonacci", "A first action", seconds=45, companions=[Mathematician], seeds=(1, 2))


@fibonacci.check(2)
def offers(run: Recording) -> list[Goal]:
    """The node offers the action /fibonacci of type Fibonacci."""
    return offered(run, FIBONACCI, FIBONACCI_TYPE, OFFER)


@fibonacci.check(1, after=offers)
def succeeds(run: Recording, goals: list[Goal]) -> None:
    """Every goal ends as succeeded."""
    for goal in goals:
        is_succeeded(goal)
    empty = [goal for goal in goals if goal.result is None or not len(goal.result.sequence)]
    if empty:
        guess = "Success without a result is none: return Fibonacci.Result(sequence=sequence)."
        raise Missed(f"{named(empty[0])} succeeded with a result", "an empty one", guess=guess)


@fibonacci.check(5, after=offers)
def gives_the_result(run: Recording, goals: list[Goal]) -> None:
    """The result holds the Fibonacci numbers F(0) to F(order)."""
    for goal in goals:
        _has_the_result(goal)


def _has_the_result(goal: Goal) -> None:
    wanted = sequence(goal.request.order)
    expected = f"{wanted} as the result of {named(goal)}"
    if goal.result is None:
        guess = "End execute with: return Fibonacci.Result(sequence=sequence)."
        raise Missed(expected, f"no result; {state(goal)}", guess=guess)
    numbers = list(goal.result.sequence)
    if numbers != wanted:
        raise Missed(expected, f"{numbers}", guess=_result_guess(numbers, wanted))


def _result_guess(numbers: list[int], wanted: list[int]) -> str:
    if not numbers:
        return "The result is empty: put the numbers into its field, Fibonacci.Result(sequence=sequence)."
    if numbers == wanted[:-1]:
        return "The last number is missing: for order 5 the sequence ends with F(5), its sixth number."
    if numbers[: len(wanted)] == wanted:
        return "There is one number too many: stop when the sequence holds F(order)."
    return "Each number is the sum of the two before it; the first two are 0 and 1."


LIMITS = (1, 20)

steps = Exercise("steps", "A server that tells and refuses", seconds=24, companions=[Examiner], seeds=(1, 2))


def _is_good(goal: Goal) -> bool:
    return LIMITS[0] <= goal.request.order <= LIMITS[1]


def _is_bad(goal: Goal) -> bool:
    return not _is_good(goal)


def _is_short(goal: Goal) -> bool:
    """A good goal that is over in time."""
    return LIMITS[0] <= goal.request.order < LIMITS[1]


def _is_told(goal: Goal) -> bool:
    """A short goal with numbers to tell."""
    return LIMITS[0] < goal.request.order < LIMITS[1]


@steps.check(4)
def accepts_good_orders(run: Recording) -> None:
    """Orders from 1 to 20 are accepted, the limits too."""
    offered(run, FIBONACCI, FIBONACCI_TYPE, OFFER)
    for goal in picked(run, FIBONACCI, _is_good):
        if goal.at("accepted") is None:
            guess = "judge gave REJECT: which way round is the `if`, and does `return` stand before ACCEPT?"
            if goal.request.order in LIMITS:
                guess = "1 and 20 are good orders: is it < or <=?"
            raise Missed(f"{named(goal)} accepted", state(goal), guess=guess)


@steps.check(
    4,
    after=accepts_good_orders,
    guess="In judge: if goal.order is below 1 or above 20, return GoalResponse.REJECT.",
)
def rejects_bad_orders(run: Recording) -> None:
    """Other orders are rejected."""
    picked(run, FIBONACCI, _is_bad)
    rejects(run, FIBONACCI, where=_is_bad)


@steps.check(
    4,
    after=accepts_good_orders,
    guess="After each new number: goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence)).",
)
def tells_its_progress(run: Recording) -> list[Goal]:
    """Each new number is told as feedback: the whole sequence so far."""
    goals = picked(run, FIBONACCI, _is_told)
    for goal in goals:
        told = [list(heard.message.sequence) for heard in goal.feedback]
        for wanted in map(sequence, range(2, goal.request.order + 1)):
            if wanted not in told:
                saw = f"{len(told)} times feedback; the last was {told[-1]}" if told else "no feedback"
                raise Missed(f"{wanted} as feedback on {named(goal)}", saw)
    return goals


@steps.check(2, after=tells_its_progress, guess="Wait once for each number: time.sleep(0.5).")
def takes_its_time(run: Recording, goals: list[Goal]) -> None:
    """The numbers come every 0.5 s."""
    for goal in goals:
        moments = stamps(goal.feedback)
        mean = (moments[-1] - moments[0]) / max(1, len(moments) - 1)
        if not 0.4 < mean < 0.6 or longest_pause(moments)[0] > 0.8:
            raise Missed(f"feedback on {named(goal)} every 0.5 s", f"every {mean:.2g} s")


@steps.check(1, after=(accepts_good_orders, tells_its_progress))
def still_right(run: Recording) -> None:
    """The result is right as before."""
    for goal in picked(run, FIBONACCI, _is_short):
        is_succeeded(goal)
        _has_the_result(goal)
