"""A first action server, which computes."""

from grader.checks import Missed
from grader.companions.goal_senders import Mathematician
from grader.exercise import Exercise
from grader.responses.course_goals import fibonacci_offered, goal_text, has_the_result, is_succeeded
from sim.evidence import Goal, Recording

fibonacci = Exercise("fibonacci", "A first action", seconds=45, companions=[Mathematician], seeds=(1, 2))


@fibonacci.check(2)
def offers(run: Recording) -> list[Goal]:
    """The node offers the action /fibonacci of type Fibonacci."""
    return fibonacci_offered(run)


@fibonacci.check(1, after=offers)
def succeeds(run: Recording, goals: list[Goal]) -> None:
    """Every goal ends as succeeded."""
    for goal in goals:
        is_succeeded(goal)
    empty = [goal for goal in goals if goal.result is None or not len(goal.result.sequence)]
    if empty:
        guess = "A success needs a result: return Fibonacci.Result(sequence=sequence)."
        raise Missed(f"{goal_text(empty[0])} succeeded with a result", "an empty one", guess=guess)


@fibonacci.check(5, after=offers)
def gives_the_result(run: Recording, goals: list[Goal]) -> None:
    """The result contains the Fibonacci numbers F(0) to F(order)."""
    for goal in goals:
        has_the_result(goal)
