"""A square out of two actions: four drives and four turns."""

import itertools
import math

from grader.checks import Missed, arrives, hinting, passes
from grader.checks.services import sent_at
from grader.companions.action_servers import DriveServer, SpinServer
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import EDGE
from grader.responses.course_goals import DRIVE, SPIN
from sim.evidence import Goal, Recording

CORNERS = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
NEAR = 0.15  # meters

square = Exercise("square_by_actions", "A square made of actions", world="yard", seconds=50,
                  companions=[DriveServer, SpinServer], may_end=True)


@square.check(4)
def sends_both_kinds(run: Recording) -> None:
    """The node sends goals to /drive_on_heading and to /spin."""
    for action in (DRIVE, SPIN):
        if not run.goals_of(action):
            hint = "In go: await self.finish(self.drive, ...), then await self.finish(self.spin, ...)."
            raise Missed(f"goals for {action}", "none", hint)


@square.check(4, after=sends_both_kinds)
def waits_for_the_end(run: Recording) -> None:
    """A goal is sent only when the previous one has ended."""
    for before, after in itertools.pairwise(_goals(run)):
        if before.ended is None or before.ended > sent_at(after) + EDGE:
            hint = ("Accepted isn't finished: await handle.get_result_async() in finish, too, and await "
                    "finish in go.")
            how = "never ended" if before.ended is None else f"ended at {before.ended:.3g} s"
            expected = f"{after.action} sent after the end of {before.action}, not at {after.requested:.3g} s"
            raise Missed(expected, f"that one {how}", hint)


@square.check(4, after=(sends_both_kinds, waits_for_the_end))
def passes_the_corners(run: Recording) -> None:
    """The robot passes (1, 0), (1, 1) and (0, 1), in this order."""
    try:
        passes(run, CORNERS, tolerance=NEAR)
    except Missed as missed:
        missed.hint = _hint(run)  # the goals say more than the robot's path
        raise


@square.check(2, after=passes_the_corners)
def comes_back(run: Recording) -> None:
    """It ends where it started, and all goals have succeeded."""
    failed = next((goal for goal in _goals(run) if goal.status != "succeeded"), None)
    if failed:
        saw = f"{failed.action} {failed.status or 'without a decision'}"
        raise Missed("all goals succeeded", saw, "Four times: drive 1 m, then turn by pi / 2.")
    try:
        passes(run, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed("three corners, then the start", missed.saw,
                     "Get the robot around the corners first.") from None
    with hinting(_no_quarter(run) or "Send four sides and four turns, then no more goals."):
        arrives(run, (0.0, 0.0), tolerance=NEAR)


def _goals(run: Recording) -> list[Goal]:
    """Those of both kinds, in the order they were sent."""
    return sorted(run.goals_of(DRIVE) + run.goals_of(SPIN), key=lambda goal: goal.requested or 0.0)


def _hint(run: Recording) -> str:
    angles = [goal.request.target_yaw for goal in run.goals_of(SPIN)]
    if not all(is_near(angle, 0.0, math.tau) for angle in angles):
        return f"target_yaw was {max(angles, key=abs):.3g}: its unit is rad; a quarter turn is math.pi / 2."
    if any(angle < 0 for angle in angles):
        return "The robot turned right: a positive target_yaw turns left."
    drives = run.goals_of(DRIVE)
    refused = next((goal for goal in drives if goal.status == "aborted"), None)
    if refused:
        return f"A drive was aborted: {refused.result.error_msg}."
    if not all(is_near(goal.request.target.x, 1.0, 0.01) for goal in drives):
        return "A side is 1 m: target.x = 1.0."
    return _no_quarter(run)


def _no_quarter(run: Recording) -> str:
    """Return what to say where a turn is by another angle than a quarter turn; "" where none is."""
    angles = (goal.request.target_yaw for goal in run.goals_of(SPIN))
    other = next((angle for angle in angles if not is_near(angle, math.pi / 2, 0.01)), None)
    return "" if other is None else f"target_yaw was {other:.3g}: a quarter turn is math.pi / 2, 1.5708 rad."
