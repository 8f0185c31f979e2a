"""An exercise with two actions: a square out of four drives and four turns."""

from __future__ import annotations

import itertools
import math

from grader.checks import Missed, arrives, check, passes
from grader.exercise import Exercise
from grader.exercises.actions.asking import DRIVE
from grader.exercises.actions.evidence import ended, hinting
from grader.exercises.actions.servers import DriveServer, SpinServer
from grader.exercises.actions.turning import SPIN
from sim.exchanges import Goal
from sim.recording import Recording

CORNERS = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
NEAR = 0.15  # metres


@check(points=4)
def sends_both_kinds(recording: Recording) -> None:
    """The node sends goals to /drive_on_heading and to /spin."""
    for action in (DRIVE, SPIN):
        if not recording.goals_of(action):
            hint = "In go: await self.finish(self.drive, ...), then await self.finish(self.spin, ...)."
            with hinting(hint):
                raise Missed(f"goals for {action}", "none")


@check(points=4, after=sends_both_kinds)
def waits_for_the_end(recording: Recording) -> None:
    """A goal is sent only when the one before has ended."""
    goals = sorted(_goals(recording), key=lambda goal: goal.asked or 0.0)
    for before, after in itertools.pairwise(goals):
        end = ended(before)
        if end is None or end > (after.asked or 0.0) + 1e-9:
            hint = "Accepted isn't done: finish awaits handle.get_result_async(), too, and go awaits finish."
            with hinting(hint):
                saw = f"that one {'never ended' if end is None else f'ended at {end:.3g} s'}"
                expected = f"{after.action} sent after the end of {before.action}, not at {after.asked:.3g} s"
                raise Missed(expected, saw)


@check(points=4, after=(sends_both_kinds, waits_for_the_end))
def passes_the_corners(recording: Recording) -> None:
    """The robot passes (1, 0), (1, 1) and (0, 1), in this order."""
    try:
        passes(recording, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed(
            missed.expected, missed.saw, _hint(recording), credit=missed.credit, picture="path"
        ) from None


@check(points=2, after=passes_the_corners)
def comes_back(recording: Recording) -> None:
    """It ends where it began, and all goals have succeeded."""
    failed = [goal for goal in _goals(recording) if goal.status != "succeeded"]
    if failed:
        saw = f"{failed[0].action} {failed[0].status or 'without a decision'}"
        raise Missed("all goals succeeded", saw, "Four times: drive 1 m, then turn by pi / 2.")
    try:
        passes(recording, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed("three corners, and then the start", missed.saw, "First pass the corners.") from None
    with hinting(_no_quarter(recording) or "Four sides and four turns, and then no more goals."):
        arrives(recording, (0.0, 0.0), tolerance=NEAR)


def _goals(recording: Recording) -> list[Goal]:
    return recording.goals_of(DRIVE) + recording.goals_of(SPIN)


def _hint(recording: Recording) -> str:
    angles = [goal.request.target_yaw for goal in recording.goals_of(SPIN)]
    if any(abs(angle) > math.tau for angle in angles):
        return f"target_yaw was {max(angles, key=abs):.3g}: its unit is rad; a quarter turn is math.pi / 2."
    if any(angle < 0 for angle in angles):
        return "The robot turned right: a positive target_yaw turns left."
    drives = recording.goals_of(DRIVE)
    refused = next((goal for goal in drives if goal.status == "aborted"), None)
    if refused:
        return f"A drive was aborted: {refused.result.error_msg}."
    if any(abs(goal.request.target.x - 1.0) > 0.01 for goal in drives):
        return "A side is 1 m: target.x = 1.0."
    words = "Four times: drive 1 m ahead, then turn left by pi / 2 rad. The picture shows your way."
    return _no_quarter(recording) or words


def _no_quarter(recording: Recording) -> str:
    """What to say where a turn is by another angle than a quarter turn; "" where none is."""
    angles = (goal.request.target_yaw for goal in recording.goals_of(SPIN))
    other = next((angle for angle in angles if abs(angle - math.pi / 2) > 0.01), None)
    return "" if other is None else f"target_yaw was {other:.3g}: a quarter turn is math.pi / 2, 1.5708 rad."


square = Exercise(
    "square_by_actions",
    "A square out of actions",
    [sends_both_kinds, waits_for_the_end, passes_the_corners, comes_back],
    world="yard",
    seconds=50,
    companions=[DriveServer, SpinServer],
)
