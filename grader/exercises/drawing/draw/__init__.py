"""A design exercise: inverse kinematics, and a figure that the arm's tip draws."""

import itertools
import math
from typing import Any

from grader.checks import Missed, draws, hinting, keeps_off, otherwise, sends_goals
from grader.checks.joints import FOLLOW_TRAJECTORY
from grader.checks.services import sent_at
from grader.exercise import Exercise
from grader.exercises.drawing.draw.figure import Designer, designer
from grader.geometry import Point
from grader.geometry.near import is_near
from grader.responses import from_course, last_before
from grader.worlds.arms import desk_of
from sim.evidence import Goal, Recording
from sim.nanoseconds import in_seconds

__all__ = ["Designer", "designer", "draw"]

TOLERANCE = 0.015  # m
FASTEST, SLACK = 2.0, 0.05  # rad/s of the quicker joint; rad
JUMPS = 0.5  # the credit for a jump to the first point
HALF_TURN = 2.5  # rad, and more: no two points of a figure are so far apart
REPLACED, TOO_LONG = "another goal was sent before it had ended", "the run ended first"
JUMP = "How far does each joint have to turn from where the arm is, and how fast can it?"

draw = Exercise("draw", "An arm that draws, your way", world=desk_of, seconds=15, companions=designer,
                seeds=(1, 2), may_end=True)


@draw.check(2)
def sends_a_goal(run: Recording) -> list[Goal]:
    """The node sends a goal to /arm_controller/follow_joint_trajectory."""
    with hinting("Send it when both the figure and the description have arrived, in the later callback."):
        return sends_goals(run, *FOLLOW_TRAJECTORY)


@draw.check(3, after=sends_a_goal, hints={
    "Each point needs a later time than the previous one, counted from the start of the whole trajectory.":
        lambda run, reason: "time_from_start" in reason,
    "Angles beyond the limits come from degrees, or from the wrong quadrant: use atan2(y, x), in radians.":
        lambda run, reason: "limits" in reason,
    "A new goal replaces the one before it: wait for the result of each goal before you send the next.":
        lambda run, reason: reason == REPLACED,
    "It takes too long: the times of all goals, and what passes between them, have to fit into the 15 s.":
        lambda run, reason: reason == TOO_LONG,
    "Read the reason: it names the point or the joint.": otherwise,
})
def can_be_followed(run: Recording, goals: list[Goal]) -> None:
    """The arm accepts it, and executes it to the end."""
    for goal, following in zip(goals, [*goals[1:], None], strict=True):
        if goal.status != "succeeded":
            reason = _reason(run, goal, following)
            raise Missed("a goal that succeeds", f"{goal.status or 'no answer'}: {reason}", about=(reason,))


@draw.check(10, after=can_be_followed, hints={
    "That is the figure mirrored at the x axis: check the sign of y.":
        lambda run: _comes_near(run, [(x, -y) for x, y in _figure(run)]),
    "The arm needs time to get to the first point, or it lags behind the figure. How far does each joint "
    "have to turn, and how fast can it?": lambda run: _jump(run),
    "The shoulder jumps by half a turn between two points: where x < 0, atan(y / x) loses the sign; use "
    "atan2(y, x).":
        lambda run: any(not is_near(after.positions[0], before.positions[0], HALF_TURN)
                        for before, after in itertools.pairwise(_points(run))),
    "It doesn't even reach the first point. Check inverse(x, y) on paper, for the arm stretched "
    "out: x = upper + fore, y = 0 gives 0, 0. Does the shoulder subtract what the bent elbow adds?":
        lambda run: not _comes_near(run, _figure(run)[:1]),
    "The figure has {figure} points, and you sent {sent}: make at least one trajectory point for "
    "each.": lambda run: (
        len(_points(run)) < len(_figure(run)) and {"figure": len(_figure(run)), "sent": len(_points(run))}
    ),
    "The arm touches the table's edge, which holds it up. First choose the other side for the elbow: see the "
    "check of the table.": lambda run: _touches(run),
    "It gets near the figure, but not onto it. Are the lengths those of /robot_description? The elbow's "
    "origin gives the length of the upper arm, and the tip's that of the forearm. And has each joint enough "
    "time where it turns back?": lambda run: True,
})
def draws_the_figure(run: Recording) -> None:
    """The tip draws the whole figure, within 1.5 cm, and nothing else once it has begun."""
    if not _points(run):
        raise Missed("a trajectory with points", "none")
    jump = _jump(run)
    try:
        draws(run, _figure(run), tolerance=TOLERANCE)
    except Missed as missed:
        missed.credit = min(missed.credit, JUMPS) if jump else missed.credit
        raise
    if jump:
        raise Missed("a goal whose first point the arm reaches in its time", jump, JUMP, credit=JUMPS)


@draw.check(5, after=draws_the_figure)
def keeps_off_the_table(run: Recording) -> None:
    """No part of the arm touches the table's edge: the elbow is on the side where the figure is."""
    hint = ("The arm can reach each point in two ways, which mirror each other. Take the one whose elbow is "
            "on the figure's side, away from the table: its angle is negative where y > 0, positive where y "
            "< 0.")
    keeps_off(run, hint)


def _reason(run: Recording, goal: Goal, following: Goal | None) -> str:
    """Return why a goal hasn't succeeded, as far as that is known."""
    if following and goal.at("rejected") is None:
        ended = goal.ended if goal.ended is not None else math.inf
        if following.requested is not None and following.requested <= ended:
            return REPLACED
    if goal.result is not None:
        return str(goal.result.error_string)
    if goal.status in ("accepted", "executing"):
        return TOO_LONG
    errors = [line.text for line in run.logs if line.from_course and line.level == "ERROR"]
    return next(iter(errors), "no reason given")


def _touches(run: Recording) -> bool:
    """Whether a part of the arm touches the table's edge."""
    try:
        keeps_off(run)
    except Missed:
        return True
    return False


def _figure(run: Recording) -> list[Point]:
    return [(point.x, point.y) for point in from_course(run, "/figure")[0].message.points]


def _points(run: Recording) -> list[Any]:
    """The points of all goals, one after the other."""
    return [point for goal in run.goals_of(FOLLOW_TRAJECTORY[0]) for point in goal.request.trajectory.points]


def _jump(run: Recording) -> str:
    """A joint that can't get to a goal's first point in its time, and where that is; or nothing."""
    for goal in run.goals_of(FOLLOW_TRAJECTORY[0]):
        state = last_before(from_course(run, "/joint_states", at_least=0), sent_at(goal))
        here = dict(zip(state.message.name, state.message.position, strict=True)) if state else {}
        trajectory = goal.request.trajectory
        for point in trajectory.points[:1]:
            time = in_seconds(point.time_from_start)
            for name, position in zip(trajectory.joint_names, point.positions, strict=False):
                if not is_near(position, here.get(name, 0.0), FASTEST * time + SLACK):
                    return f"the {name} at {position:.2f} rad after {time:.3g} s"
    return ""


def _comes_near(run: Recording, points: list[Point]) -> bool:
    """Return whether the tip came near all of these points."""
    return all(min(math.dist(point, pose[1:3]) for pose in run.tip) < 4 * TOLERANCE for point in points)
