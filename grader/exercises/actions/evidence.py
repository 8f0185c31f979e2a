"""What the checks of 04_actions have in common: the goals of our clients, and the right sequences."""

from __future__ import annotations

import re
from collections.abc import Callable

from grader.checks import Missed, hinting, serves_action
from grader.checks.actions import state
from sim.evidence import Goal, Recording

FIBONACCI, FIBONACCI_TYPE = "/fibonacci", "example_interfaces/action/Fibonacci"


def offered(run: Recording, action: str, type: str, hint: str) -> list[Goal]:
    """The goals that came to a server of the action. Raises Missed, with the hint where there is no other."""
    with hinting(hint):
        serves_action(run, action, type)
    return picked(run, action)


def picked(run: Recording, action: str, where: Callable[[Goal], bool] = lambda goal: True) -> list[Goal]:
    """The goals of ours for an action that fit. Raises Missed where none was sent."""
    goals = [goal for goal in run.goals_of(action) if goal.requested_by_course]
    if not goals:
        saw = "it was gone before a goal could be sent"
        guess = "The node has to go on: main() ends with rclpy.spin(node), or executor.spin() with brackets."
        raise Missed(f"a server of {action} that takes goals", saw, guess=guess)
    found = [goal for goal in goals if where(goal)]
    if not found:
        expected = f"every goal for {action} brought to an end, so that the next one can be sent"
        guess = "Each goal has to end: succeed(), canceled() or abort(), and then return."
        raise Missed(expected, f"only {len(goals)} sent in {run.ended.stamp:.3g} s", guess=guess)
    return found


def sequence(order: int) -> list[int]:
    """The Fibonacci numbers F(0) to F(order), and at least the first two."""
    numbers = [0, 1]
    while len(numbers) <= order:
        numbers.append(numbers[-1] + numbers[-2])
    return numbers


def named(goal: Goal) -> str:
    """A goal for /fibonacci in words: "the goal (order=7) at 1 s"."""
    return f"the goal (order={goal.request.order}) at {goal.requested or 0.0:.3g} s"


def is_succeeded(goal: Goal) -> None:
    """The goal for /fibonacci ended as succeeded. Raises Missed if not."""
    if goal.status != "succeeded":
        guess = "Call goal_handle.succeed() before you return the result."
        raise Missed(f"{named(goal)} succeeded", state(goal), guess=guess)


def lines(run: Recording, level: str = "") -> list[str]:
    """What the student's client logged, of one level or of all."""
    return [line.text for line in run.logs if level in ("", line.level) and not line.from_course]


def numbers_in(text: str) -> list[float]:
    """The numbers in a text."""
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]
