"""Exercises with the robot: a node with other names, and a square."""

from __future__ import annotations

import itertools
import math

from grader.checks import (
    Missed,
    arrives,
    check,
    follows,
    passes,
    publishes,
    series,
    stands_still,
    subscribes,
    travelled,
)
from grader.exercise import Exercise
from grader.exercises.advice import advising
from sim.recording import Recording, stamps

PAIRS = "A remapping is a pair of names: first the one in the node's code, then the one on the robot."
TWIST, ODOMETRY = "geometry_msgs/msg/Twist", "nav_msgs/msg/Odometry"


@check(points=4)
def commands_reach_the_robot(recording: Recording) -> None:
    """The node's commands go to /cmd_vel."""
    with advising(recording, PAIRS):
        publishes(recording, "/cmd_vel", TWIST)


@check(points=4)
def odometry_reaches_the_node(recording: Recording) -> None:
    """The node hears the robot's /odom."""
    with advising(recording, PAIRS):
        subscribes(recording, "/odom", ODOMETRY)


@check(points=4, after=(commands_reach_the_robot, odometry_reaches_the_node))
def drives_one_metre(recording: Recording) -> None:
    """The robot drives one metre straight on and stops there."""
    with advising(recording, "OneMetre does this by itself, once both names are right."):
        arrives(recording, (1.0, 0.0), tolerance=0.1)
    stands_still(recording)


remapping = Exercise(
    "remapping",
    "Another robot's node",
    [commands_reach_the_robot, odometry_reaches_the_node, drives_one_metre],
    world="yard",
    seconds=8,
)


START, CORNERS = (0.0, 0.0), [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
NEAR = 0.15  # metres
TIMEOUT = 0.5  # seconds after which the robot stops without a command


@check(points=2)
def sends_velocities(recording: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(recording, "/cmd_vel", TWIST)


@check(points=8, after=sends_velocities)
def passes_the_corners(recording: Recording) -> None:
    """The robot passes (1, 0), (1, 1), (0, 1) and (0, 0), in this order."""
    with advising(recording, _driving_hint(recording)):
        passes(recording, [*CORNERS, START], tolerance=NEAR)


@check(points=3, after=passes_the_corners)
def keeps_to_the_line(recording: Recording) -> None:
    """On its way the robot stays within 15 cm of the square's sides."""
    if travelled(recording) < 3.0:
        saw = f"a way of {travelled(recording):.2f} m"
        raise Missed("a way along all four sides, 4 m", saw, "Drive the whole square first.", picture="path")
    with advising(recording, "The picture shows where it leaves the square."):
        follows(recording, [START, *CORNERS, START], tolerance=NEAR)


@check(points=3, after=passes_the_corners)
def closes_the_square(recording: Recording) -> None:
    """After the third corner the robot ends where it began, within 15 cm."""
    try:
        passes(recording, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed("three corners, and then the start", missed.saw, "First pass the corners.") from None
    with advising(recording, "After four sides and four corners, send zeros."):
        arrives(recording, START, tolerance=NEAR)


@check(points=2, after=passes_the_corners)
def stops_at_the_end(recording: Recording) -> None:
    """The robot stands still at the end."""
    stands_still(recording)


def _driving_hint(recording: Recording) -> str:
    """The usual reasons for a square that is none."""
    fastest = max(abs(value) for _, value in series(recording, "/cmd_vel", "angular.z"))
    if fastest > math.tau:
        return f"angular.z was {fastest:.3g}: its unit is rad/s, and a quarter turn is pi/2 = 1.57 rad."
    if any(value for _, value in series(recording, "/cmd_vel", "linear.y")):
        return "This robot can't move sideways, so it ignores linear.y: turn, then drive ahead with linear.x."
    moments = stamps(recording.messages("/cmd_vel"))
    if any(after - before > TIMEOUT for before, after in itertools.pairwise(moments)):
        return "The robot stops by itself 0.5 s after the last command: repeat it at 10 Hz, from a timer."
    if any(math.dist((1.0, -1.0), (pose.x, pose.y)) < NEAR for pose in recording.path):
        return "The robot turned right. A positive angular.z turns left."
    return "Speed times seconds is the way: 1 m for a side, pi/2 rad for a corner. The picture shows yours."


square = Exercise(
    "square",
    "A square",
    [sends_velocities, passes_the_corners, keeps_to_the_line, closes_the_square, stops_at_the_end],
    world="yard",
    seconds=60,
)
