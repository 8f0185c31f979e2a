"""Exercises with the robot: a node with other names, and a square."""

from __future__ import annotations

import itertools
import math

from grader.checks import (
    Missed,
    arrives,
    ends_with_a_stop,
    follows,
    hinting,
    passes,
    publishes,
    series,
    stands_still,
    subscribes,
    travelled,
)
from grader.exercise import Exercise
from sim.evidence import Recording, stamps

TWIST, ODOMETRY = "geometry_msgs/msg/Twist", "nav_msgs/msg/Odometry"

remapping = Exercise("remapping", "Another robot's node", world="yard", seconds=8, names_count=True)
PAIRS = "A remapping is a pair of names: first the one in the node's code, then the one on the robot."


@remapping.check(4, guess=PAIRS)
def commands_reach_the_robot(run: Recording) -> None:
    """The node's commands go to /cmd_vel."""
    publishes(run, "/cmd_vel", TWIST)


@remapping.check(4, guess=PAIRS)
def odometry_reaches_the_node(run: Recording) -> None:
    """The node hears the robot's /odom."""
    subscribes(run, "/odom", ODOMETRY)


@remapping.check(
    4,
    after=(commands_reach_the_robot, odometry_reaches_the_node),
    guess="OneMetre does this by itself, once both names are right.",
)
def drives_one_metre(run: Recording) -> None:
    """The robot drives one metre straight on and stops there."""
    arrives(run, (1.0, 0.0), tolerance=0.1)
    stands_still(run)
    ends_with_a_stop(run)


square = Exercise("square", "A square", world="yard", seconds=60, may_end=True, extra_allowed=True)
START, CORNERS = (0.0, 0.0), [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
NEAR = 0.15  # metres
TIMEOUT = 0.5  # seconds after which the robot stops without a command


@square.check(2)
def sends_velocities(run: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(run, "/cmd_vel", TWIST)


@square.check(8, after=sends_velocities)
def passes_the_corners(run: Recording) -> None:
    """The robot passes (1, 0), (1, 1), (0, 1) and (0, 0), in this order."""
    with hinting(guess=_usual_reason(run)):
        passes(run, [*CORNERS, START], tolerance=NEAR)


def _usual_reason(run: Recording) -> str:
    """Why a square is none, as a hint."""
    fastest = max(abs(value) for _, value in series(run, "/cmd_vel", "angular.z"))
    if fastest > math.tau:
        return f"angular.z was {fastest:.3g}: its unit is rad/s, and a quarter turn is pi/2 = 1.57 rad."
    if any(value for _, value in series(run, "/cmd_vel", "linear.y")):
        return "This robot can't move sideways, so it ignores linear.y: turn, then drive ahead with linear.x."
    moments = stamps(run.messages("/cmd_vel"))
    if any(after - before > TIMEOUT for before, after in itertools.pairwise(moments)):
        return "The robot stops by itself 0.5 s after the last command: repeat it at 10 Hz, from a timer."
    if any(math.dist((1.0, -1.0), (pose.x, pose.y)) < NEAR for pose in run.path):
        return "The robot turned right. A positive angular.z turns left."
    return "Speed times seconds is the way: 1 m for a side, pi/2 rad for a corner. The picture shows yours."


@square.check(3, after=passes_the_corners, guess="The picture shows where it leaves the square.")
def keeps_to_the_line(run: Recording) -> None:
    """On its way the robot stays within 15 cm of the square's sides."""
    way = travelled(run)
    if way < 3.0:
        expected, saw = "a way along all four sides, 4 m", f"a way of {way:.2f} m"
        raise Missed(expected, saw, "Drive the whole square first.", picture="path")
    follows(run, [START, *CORNERS, START], tolerance=NEAR)


@square.check(3, after=passes_the_corners, guess="After four sides and four corners, send zeros.")
def closes_the_square(run: Recording) -> None:
    """After the third corner the robot ends where it began, within 15 cm."""
    try:
        passes(run, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed("three corners, and then the start", missed.saw, "First pass the corners.") from None
    arrives(run, START, tolerance=NEAR)


@square.check(2, after=passes_the_corners)
def stops_at_the_end(run: Recording) -> None:
    """The robot stands still at the end."""
    stands_still(run)
    ends_with_a_stop(run)
