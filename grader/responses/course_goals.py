"""Goals that the course's clients send to a student's server, and the sequences that are right."""

from __future__ import annotations

from collections.abc import Callable

from grader.checks.actions import serves_action, state
from grader.checks.check import Missed, hinting
from sim.evidence import Goal, Recording

FIBONACCI, FIBONACCI_TYPE = "/fibonacci", "example_interfaces/action/Fibonacci"
DRIVE, SPIN = "/drive_on_heading", "/spin"
OFFER = 'ActionServer(self, Fibonacci, "/fibonacci", self.execute): node, type, name and callback.'


def offered(run: Recording, action: str, type: str) -> list[Goal]:
    """Return the course's goals for a server of the action. Raises Missed without one."""
    serves_action(run, action, type)
    return picked(run, action)


def fibonacci_offered(run: Recording) -> list[Goal]:
    """Return the course's goals for a server of /fibonacci. Raises Missed without one, with a hint."""
    with hinting(OFFER):
        serves_action(run, FIBONACCI, FIBONACCI_TYPE)
    return picked(run, FIBONACCI)


def picked(run: Recording, action: str, where: Callable[[Goal], bool] = lambda goal: True) -> list[Goal]:
    """Return the course's goals for an action that fit. Raises Missed if none was sent."""
    goals = [goal for goal in run.goals_of(action) if goal.requested_by_course]
    if not goals:
        saw = "it had exited before a goal could be sent"
        guess = (
            "The node has to keep running: end main() with rclpy.spin(node), or executor.spin() with "
            "parentheses."
        )
        raise Missed(f"a server of {action} that receives goals", saw, guess=guess)
    found = [goal for goal in goals if where(goal)]
    if not found:
        expected = f"every goal for {action} brought to an end, so that the next one can be sent"
        guess = "Each goal has to end: call succeed(), canceled() or abort(), and then return."
        raise Missed(expected, f"only {len(goals)} sent in {run.ended.stamp:.3g} s", guess=guess)
    return found


def sequence(order: int) -> list[int]:
    """Return the Fibonacci numbers F(0) to F(order), and at least the first two."""
    numbers = [0, 1]
    while len(numbers) <= order:
        numbers.append(numbers[-1] + numbers[-2])
    return numbers


def goal_text(goal: Goal) -> str:
    """Return a goal for /fibonacci as text: "the goal (order=7) at 1 s"."""
    return f"the goal (order={goal.request.order}) at {goal.requested or 0.0:.3g} s"


def is_succeeded(goal: Goal) -> None:
    """Raise Missed if a goal for /fibonacci has not succeeded."""
    if goal.status != "succeeded":
        guess = "Call goal_handle.succeed() before you return the result."
        raise Missed(f"{goal_text(goal)} succeeded", state(goal), guess=guess)


def lines(run: Recording, level: str = "") -> list[str]:
    """Return what the student's programs logged, at one level or at all."""
    return [line.text for line in run.logs if level in ("", line.level) and not line.from_course]


def quoted(texts: list[str]) -> str:
    """Return the first three log lines in quotes, or "no line"."""
    return ", ".join(f"“{text}”" for text in texts[:3]) or "no line"


def has_the_result(goal: Goal) -> None:
    """Raise Missed if a goal for /fibonacci has not the right sequence as its result."""
    wanted = sequence(goal.request.order)
    expected = f"{wanted} as the result of {goal_text(goal)}"
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
        return "There is one number too many: stop when the sequence contains F(order)."
    return "Each number is the sum of the two before it; the first two are 0 and 1."
