"""An action server that publishes feedback, and rejects what it cannot do."""

from grader.checks import Missed, rejects
from grader.checks.actions import state
from grader.checks.topics import longest_pause
from grader.companions.goal_senders import Examiner
from grader.exercise import Exercise
from grader.responses.course_goals import (
    FIBONACCI,
    fibonacci_offered,
    goal_text,
    has_the_result,
    is_succeeded,
    picked,
    sequence,
)
from grader.variants import Variants
from sim.evidence import Goal, Recording, stamps

LIMITS = (1, 20)

steps = Exercise("steps", "A server that reports and refuses", seconds=24, companions=[Examiner],
                 seeds=(1, 2), variants=Variants(
    {"pause": (0.5, 0.3, 0.2), "half": ("half a second", "0.3 s", "0.2 s")},
    texts=("takes {half}", "{pause:g} s", "time.sleep({pause:g})"),
))


def _is_good(goal: Goal) -> bool:
    return bool(LIMITS[0] <= goal.request.order <= LIMITS[1])


def _is_bad(goal: Goal) -> bool:
    return not _is_good(goal)


@steps.check(4)
def accepts_good_orders(run: Recording) -> None:
    """Orders from 1 to 20 are accepted, both limits included."""
    fibonacci_offered(run)
    for goal in picked(run, FIBONACCI, _is_good):
        if goal.at("accepted") is None:
            guess = ("judge returned REJECT: is the `if` the right way round, and is there a `return` before "
                     "ACCEPT?")
            if goal.request.order in LIMITS:
                guess = "1 and 20 are good orders: is it < or <=?"
            raise Missed(f"{goal_text(goal)} accepted", state(goal), guess=guess)


@steps.check(4, after=accepts_good_orders,
             guess="In judge: if goal.order is below 1 or above 20, return GoalResponse.REJECT.")
def rejects_bad_orders(run: Recording) -> None:
    """Other orders are rejected."""
    picked(run, FIBONACCI, _is_bad)
    rejects(run, FIBONACCI, where=_is_bad)


@steps.check(
    4,
    after=accepts_good_orders,
    guess="After each new number: goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence)).",
)
def publishes_feedback(run: Recording) -> list[Goal]:
    """Each new number is sent as feedback: the whole sequence so far."""
    goals = picked(run, FIBONACCI, lambda goal: LIMITS[0] < goal.request.order < LIMITS[1])
    for goal in goals:
        sent = [list(row.message.sequence) for row in goal.feedback]
        for wanted in map(sequence, range(2, goal.request.order + 1)):
            if wanted not in sent:
                saw = f"{len(sent)} feedback messages; the last was {sent[-1]}" if sent else "no feedback"
                raise Missed(f"{wanted} as feedback on {goal_text(goal)}", saw)
    return goals


@steps.check(2, after=publishes_feedback, guess="Wait once for each number: time.sleep(0.5).")
def takes_its_time(run: Recording, goals: list[Goal]) -> None:
    """The numbers come every 0.5 s."""
    pause = steps.drawn.pause
    for goal in goals:
        moments = stamps(goal.feedback)
        mean = (moments[-1] - moments[0]) / max(1, len(moments) - 1)
        if not 0.8 * pause < mean < 1.2 * pause or longest_pause(moments)[0] > pause + 0.3:
            raise Missed(f"feedback on {goal_text(goal)} every {pause} s", f"every {mean:.2g} s")


@steps.check(1, after=(accepts_good_orders, publishes_feedback))
def still_right(run: Recording) -> None:
    """The result is still right."""
    for goal in picked(run, FIBONACCI, lambda goal: _is_good(goal) and goal.request.order < LIMITS[1]):
        is_succeeded(goal)
        has_the_result(goal)
