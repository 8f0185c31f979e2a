"""Exercises on servers: a first one that computes, and one that tells how it is doing and says no."""

from __future__ import annotations

from grader.checks import Missed, check
from grader.checks.actions import rejects
from grader.exercise import Exercise
from grader.exercises.actions.evidence import (
    FIBONACCI,
    FIBONACCI_TYPE,
    longest_pause,
    named,
    offered,
    picked,
    sequence,
    state,
)
from grader.exercises.actions.partners import Examiner, Mathematician
from grader.exercises.advice import advising
from sim.exchanges import Goal
from sim.recording import Recording, stamps

OFFER = 'ActionServer(self, Fibonacci, "/fibonacci", self.execute): node, type, name and callback.'
SUCCEED = "Call goal_handle.succeed() before you return the result."


@check(points=3)
def offers(recording: Recording) -> None:
    """The node offers the action /fibonacci of type Fibonacci."""
    offered(recording, FIBONACCI, FIBONACCI_TYPE, OFFER)


@check(points=2, after=offers)
def succeeds(recording: Recording) -> None:
    """Every goal ends as succeeded."""
    for goal in picked(recording, FIBONACCI):
        if goal.status != "succeeded":
            with advising(recording, SUCCEED):
                raise Missed(f"{named(goal)} succeeded", state(goal))


@check(points=3, after=offers)
def gives_the_result(recording: Recording) -> None:
    """The result holds the Fibonacci numbers F(0) to F(order)."""
    for goal in picked(recording, FIBONACCI):
        _right_result(recording, goal)


def _right_result(recording: Recording, goal: Goal) -> None:
    wanted = sequence(goal.request.order)
    if goal.result is None:
        with advising(recording, "End execute with: return Fibonacci.Result(sequence=sequence)."):
            raise Missed(f"{wanted} as the result of {named(goal)}", f"no result; {state(goal)}")
    numbers = list(goal.result.sequence)
    if numbers != wanted:
        with advising(recording, _result_hint(numbers, wanted)):
            raise Missed(f"{wanted} as the result of {named(goal)}", f"{numbers}")


def _result_hint(numbers: list[int], wanted: list[int]) -> str:
    if not numbers:
        return "The result is empty: put the numbers into its field, Fibonacci.Result(sequence=sequence)."
    if numbers == wanted[:-1]:
        return "The last number is missing: for order 5 the sequence ends with F(5), its sixth number."
    if numbers[: len(wanted)] == wanted:
        return "There is one number too many: stop when the sequence holds F(order)."
    return "Each number is the sum of the two before it; the first two are 0 and 1."


fibonacci = Exercise(
    "fibonacci",
    "A first action",
    [offers, succeeds, gives_the_result],
    seconds=20,
    companions=[Mathematician],
    seeds=(1, 2),
)


LIMITS = (1, 20)


def _is_good(goal: Goal) -> bool:
    return LIMITS[0] <= goal.request.order <= LIMITS[1]


def _is_told(goal: Goal) -> bool:
    """A goal with numbers to tell, short enough to be over in time."""
    return 1 < goal.request.order < LIMITS[1]


@check(points=4)
def accepts_good_orders(recording: Recording) -> None:
    """Orders from 1 to 20 are accepted, the limits too."""
    offered(recording, FIBONACCI, FIBONACCI_TYPE, OFFER)
    for goal in picked(recording, FIBONACCI, _is_good):
        if goal.at("accepted") is None:
            at_limit = goal.request.order in LIMITS
            hint = "judge gave REJECT: which way round is the `if`, and does `return` stand before ACCEPT?"
            if at_limit:
                hint = "1 and 20 are good orders: is it < or <=?"
            with advising(recording, hint):
                raise Missed(f"{named(goal)} accepted", state(goal), credit=0.0)


@check(points=4, after=accepts_good_orders)
def rejects_bad_orders(recording: Recording) -> None:
    """Other orders are rejected."""
    picked(recording, FIBONACCI, lambda goal: not _is_good(goal))
    hint = "In judge: if goal.order is below 1 or above 20, return GoalResponse.REJECT."
    with advising(recording, hint):
        rejects(recording, FIBONACCI, where=lambda goal: not _is_good(goal))


@check(points=4, after=accepts_good_orders)
def tells_its_progress(recording: Recording) -> None:
    """Each new number is told as feedback: the whole sequence so far."""
    hint = "After each new number: goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))."
    for goal in picked(recording, FIBONACCI, _is_told):
        wanted = [sequence(n) for n in range(2, goal.request.order + 1)]
        told = [list(heard.message.sequence) for heard in goal.feedback]
        missing = [numbers for numbers in wanted if numbers not in told]
        if missing:
            saw = f"{len(told)} times feedback; the last was {told[-1]}" if told else "no feedback"
            with advising(recording, hint):
                raise Missed(f"{missing[0]} as feedback on {named(goal)}", saw)


@check(points=2, after=tells_its_progress)
def takes_its_time(recording: Recording) -> None:
    """The numbers come every 0.5 s."""
    for goal in picked(recording, FIBONACCI, _is_told):
        moments = stamps(goal.feedback)
        mean = (moments[-1] - moments[0]) / max(1, len(moments) - 1)
        if not 0.4 < mean < 0.6 or longest_pause(moments) > 0.8:
            with advising(recording, "Wait once for each number: time.sleep(0.5)."):
                raise Missed(f"feedback on {named(goal)} every 0.5 s", f"every {mean:.2g} s")


@check(points=1, after=accepts_good_orders)
def still_right(recording: Recording) -> None:
    """The result is right as before."""
    for goal in picked(recording, FIBONACCI, lambda goal: 0 < goal.request.order < LIMITS[1]):
        if goal.status != "succeeded":
            with advising(recording, SUCCEED):
                raise Missed(f"{named(goal)} succeeded", state(goal))
        _right_result(recording, goal)


steps = Exercise(
    "steps",
    "A server that tells and refuses",
    [accepts_good_orders, rejects_bad_orders, tells_its_progress, takes_its_time, still_right],
    seconds=24,
    companions=[Examiner],
    seeds=(1, 2),
)
