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
from sim.recording import Recording

TWIST, ODOMETRY = "geometry_msgs/msg/Twist", "nav_msgs/msg/Odometry"


@check(points=4)
def commands_reach_the_robot(recording: Recording) -> None:
    """The node's commands go to /cmd_vel."""
    publishes(recording, "/cmd_vel", TWIST)


@check(points=4)
def odometry_reaches_the_node(recording: Recording) -> None:
    """The node hears the robot's /odom."""
    subscribes(recording, "/odom", ODOMETRY)


@check(points=4, after=(commands_reach_the_robot, odometry_reaches_the_node))
def drives_one_metre(recording: Recording) -> None:
    """The robot drives one metre straight on and stops there."""
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


@check(points=2)
def sends_velocities(recording: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(recording, "/cmd_vel", TWIST)


@check(points=8, after=sends_velocities)
def passes_the_corners(recording: Recording) -> None:
    """The robot passes (1, 0), (1, 1), (0, 1) and (0, 0), in this order."""
    try:
        passes(recording, [*CORNERS, START], tolerance=NEAR)
    except Missed as missed:
        hint = missed.hint or _driving_hint(recording)
        raise Missed(missed.expected, missed.saw, hint, credit=missed.credit, picture="path") from None


@check(points=3, after=passes_the_corners)
def keeps_to_the_line(recording: Recording) -> None:
    """On its way the robot stays within 15 cm of the square's sides."""
    if travelled(recording) < 3.0:
        saw = f"a way of {travelled(recording):.2f} m"
        raise Missed("a way along all four sides, 4 m", saw, "Drive the whole square first.", picture="path")
    follows(recording, [START, *CORNERS, START], tolerance=NEAR)


@check(points=3, after=passes_the_corners)
def closes_the_square(recording: Recording) -> None:
    """After the third corner the robot ends where it began, within 15 cm."""
    try:
        passes(recording, CORNERS, tolerance=NEAR)
    except Missed as missed:
        raise Missed("three corners, and then the start", missed.saw, "First pass the corners.") from None
    arrives(recording, START, tolerance=NEAR)


@check(points=2, after=passes_the_corners)
def stops_at_the_end(recording: Recording) -> None:
    """The robot stands still at the end."""
    stands_still(recording)


def _driving_hint(recording: Recording) -> str:
    """The usual reasons for a square that is none."""
    moving = [heard.stamp for heard in recording.messages("/cmd_vel")]
    gap = max((after - before for before, after in itertools.pairwise(moving)), default=0.0)
    if any(math.dist((1.0, -1.0), (pose.x, pose.y)) < NEAR for pose in recording.path):
        return "The robot turned right. A positive angular.z turns left."
    fastest = max(abs(value) for _, value in series(recording, "/cmd_vel", "angular.z"))
    if fastest > 6.3:
        return f"angular.z was {fastest:.3g}: its unit is rad/s, and a quarter turn is pi/2 = 1.57 rad."
    if gap > 0.5 or len(moving) < 10:
        return "The robot stops by itself 0.5 s after the last command: repeat it at 10 Hz, from a timer."
    return "Speed times seconds is the way: 1 m for a side, pi/2 rad for a corner. The picture shows yours."


square = Exercise(
    "square",
    "A square",
    [sends_velocities, passes_the_corners, keeps_to_the_line, closes_the_square, stops_at_the_end],
    world="yard",
    seconds=60,
)
