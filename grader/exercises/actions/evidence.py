"""What the checks of 04_actions have in common: the goals of our clients, and the right sequences."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from grader.checks import Missed, serves_action
from grader.exercises.advice import advising
from sim.exchanges import Goal
from sim.recording import Recording, Seconds

FIBONACCI, FIBONACCI_TYPE = "/fibonacci", "example_interfaces/action/Fibonacci"
TWIST = "geometry_msgs/msg/Twist"


@contextmanager
def hinting(hint: str) -> Iterator[None]:
    """Give a miss in the block this hint, unless it has one."""
    try:
        yield
    except Missed as missed:
        raise Missed(
            missed.expected, missed.saw, missed.hint or hint, credit=missed.credit, picture=missed.picture
        ) from None


def offered(recording: Recording, action: str, type: str, hint: str) -> None:
    """The action has a server that goals come to. Raises Missed, with this hint where there is no other."""
    with hinting(hint):
        serves_action(recording, action, type)
    picked(recording, action)


def sequence(order: int) -> list[int]:
    """The Fibonacci numbers F(0) to F(order), and at least the first two."""
    numbers = [0, 1]
    while len(numbers) <= order:
        numbers.append(numbers[-1] + numbers[-2])
    return numbers


def picked(
    recording: Recording, action: str, where: Callable[[Goal], bool] = lambda goal: True
) -> list[Goal]:
    """The goals of an action that fit. Raises Missed where none was sent."""
    goals = recording.goals_of(action)
    if not goals:
        hint = "The node has to go on: main() ends with rclpy.spin(node), or executor.spin() with brackets."
        with advising(recording, hint):
            raise Missed(f"a server of {action} that takes goals", "it was gone before a goal could be sent")
    found = [goal for goal in goals if where(goal)]
    if not found:
        with advising(recording, "Each goal has to end: succeed(), canceled() or abort(), and then return."):
            expected = f"every goal for {action} brought to an end, so that the next one can be sent"
            raise Missed(expected, f"only {len(goals)} sent in {recording.ended.stamp:.3g} s")
    return found


def ended(goal: Goal) -> Seconds | None:
    """When a goal came to its end; None while it hasn't."""
    return goal.at(goal.status) if goal.over else None


def named(goal: Goal) -> str:
    """A goal for /fibonacci in words: "the goal (order=7) at 1 s"."""
    return f"the goal (order={goal.request.order}) at {goal.asked or 0.0:.3g} s"


def state(goal: Goal) -> str:
    """How far a goal came, in words."""
    stamp = goal.at(goal.status)
    if not goal.status or stamp is None:
        return "no decision on it"
    return f"{goal.status} at {stamp:.3g} s" if goal.over else f"still {goal.status} at the end"


def lines(recording: Recording, since: Seconds, until: Seconds, level: str = "") -> list[str]:
    """What the student's client logged in a time, of one level or of all."""
    theirs = [line for line in recording.logs if since - 1e-9 <= line.stamp <= until + 1e-9]
    return [line.text for line in theirs if level in ("", line.level) and not _is_ours(line.node)]


def _is_ours(logger: str) -> bool:
    return logger in {"late_fibonacci", "drive_server", "spin_server"}


def numbers_in(text: str) -> list[float]:
    """The numbers in a text."""
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]


def holds(text: str, numbers: list[int]) -> bool:
    """Whether a text has these numbers one after the other."""
    found = numbers_in(text)
    return any(found[begin : begin + len(numbers)] == numbers for begin in range(len(found)))


def longest_pause(moments: list[Seconds]) -> Seconds:
    """The longest time between two moments; 0 for fewer than two."""
    return max((after - before for before, after in itertools.pairwise(moments)), default=0.0)
