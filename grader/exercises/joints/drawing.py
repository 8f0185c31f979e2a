"""The last exercise on joints: inverse kinematics, and a figure that the arm's tip draws."""

from __future__ import annotations

import math

from grader.checks import Missed, draws, hinting, keeps_off, sends_goals
from grader.exercise import Exercise
from grader.exercises.joints.designer import designer
from grader.exercises.joints.following import ACTION, TYPE
from grader.exercises.joints.places import desk_of
from sim.evidence import Goal, Recording

TOLERANCE = 0.015  # m

draw = Exercise("draw", "An arm that draws", world=desk_of, seconds=10, companions=designer, seeds=(1, 2))


@draw.check(2)
def sends_a_goal(run: Recording) -> list[Goal]:
    """The node sends a goal to /arm_controller/follow_joint_trajectory."""
    with hinting("Send it when the figure and the description have come, in the callback of the later one."):
        return sends_goals(run, ACTION, TYPE)


@draw.check(3, after=sends_a_goal)
def can_be_followed(run: Recording, goals: list[Goal]) -> None:
    """The arm accepts it, and comes to its end."""
    wrong = next((goal for goal in goals if goal.status != "succeeded"), None)
    if wrong:
        said = [line.text for line in run.logs if line.from_course and line.level == "ERROR"]
        why = said[0] if said else "no reason given"
        if wrong.result is not None:
            why = wrong.result.error_string
        raise Missed("a goal that succeeds", f"{wrong.status or 'no answer'}: {why}", _why_not(why))


@draw.check(10, after=can_be_followed)
def draws_the_figure(run: Recording) -> None:
    """The tip draws the whole figure, and nothing else once it has begun, within 1.5 cm."""
    line = _line(run)
    try:
        draws(run, line, tolerance=TOLERANCE)
    except Missed as missed:
        missed.hint = _why_off(run, line)
        raise


@draw.check(5, after=draws_the_figure)
def keeps_off_the_table(run: Recording) -> None:
    """No part of the arm touches the table's edge: the elbow is on the side where the figure is."""
    hint = (
        "To every place there are two ways to bend the arm, mirrored. Take the one whose elbow "
        "is on the figure's side, away from the table: its angle negative where y > 0, positive where y < 0."
    )
    keeps_off(run, hint)


def _line(run: Recording) -> list[tuple[float, float]]:
    told = next(one for one in run.messages("/figure") if one.from_course).message
    return [(point.x, point.y) for point in told.points]


def _why_not(why: str) -> str:
    """The usual reasons for a goal that isn't followed."""
    if "time_from_start" in why:
        return "Each point comes later than the one before: the first after 3 s, then 0.15 s more for each."
    if "limits" in why:
        return "Angles beyond the limits come of degrees, or of a wrong quadrant: use atan2(y, x), radians."
    return "Read the reason: it says which point or joint it is about."


def _why_off(run: Recording, line: list[tuple[float, float]]) -> str:
    """The usual reasons for another figure."""
    if _near(run, [(x, -y) for x, y in line]):
        return "That is the figure, mirrored at the x axis: look at the sign of y."
    points = run.goals_of(ACTION)[0].request.trajectory.points
    if points[0].time_from_start.sec < 1:
        return "The arm needs time to get to the first point: give it 3 s, or it runs after the figure."
    if not _near(run, line[:1]):
        return (
            "It doesn't even come to the first point. Check inverse(x, y) on paper, for the arm stretched "
            "out: x = upper + fore, y = 0 gives 0, 0. Does the shoulder take away what the bent elbow adds?"
        )
    if len(points) < len(line):
        return f"The figure has {len(line)} points, and the trajectory {len(points)}: each becomes one."
    return (
        "It comes near the figure, and not onto it. Are the lengths those of /robot_description? The elbow's "
        "origin says how long the upper arm is, and the tip's how long the forearm is."
    )


def _near(run: Recording, points: list[tuple[float, float]]) -> bool:
    """Whether the tip came near all of these points."""
    tip = [(pose.x, pose.y) for pose in run.tip]
    return all(min(math.dist(point, place) for place in tip) < 4 * TOLERANCE for point in points)
