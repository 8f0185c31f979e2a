"""An exercise on control: follow the wall round a room."""

from __future__ import annotations

import itertools
import math
import statistics

from grader.checks import Missed, keeps_clear, passes, publishes, travelled, until_a_touch
from grader.diagnosis.driving import refused_command
from grader.exercise import Exercise
from grader.worlds.rooms import MARGIN, gallery
from sim.evidence import Pose, Recording

NEAR, FAR = 0.3, 0.8  # metres from the wall
SETTLED = 3.0  # seconds
SHARE = 0.9  # of the time


wall = Exercise("wall", "Round the room", world=gallery, seconds=90, seeds=(1, 2))


@wall.check(2)
def leaves_the_start(run: Recording) -> None:
    """The robot drives ahead, with commands on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")
    if travelled(run) < 0.5:
        raise Missed(
            "a robot that drives",
            f"a way of {travelled(run):.2f} m",
            guess="While nothing is ahead, linear.x should be 0.2 or more.",
            picture="path",
        )


@wall.check(4, after=leaves_the_start)
def goes_round(run: Recording) -> None:
    """It goes round the room, with the wall on its right: past all four corners, within 90 s."""
    left, low, right, top = run.world.bounds
    corners = {
        "lower right": (right - MARGIN, low + MARGIN),
        "upper right": (right - MARGIN, top - MARGIN),
        "upper left": (left + MARGIN, top - MARGIN),
        "lower left": (left + MARGIN, low + MARGIN),
    }
    try:
        passes(until_a_touch(run), list(corners.values()), tolerance=0.6)
    except Missed as missed:
        done = round(missed.credit * len(corners))
        raise Missed(
            f"the four corners: {', '.join(corners)}",
            f"{done} of them; then it never came within 0.6 m of the {list(corners)[done]} one's inside",
            _why_not_round(run),
            credit=max(0, done - 1) / (len(corners) - 1),  # one may be passed by chance
            picture="path",
        ) from None


@wall.check(8, after=goes_round)
def keeps_the_distance(run: Recording) -> None:
    """It keeps 30 cm to 80 cm from the wall on its right, for nine tenths of the time or more."""
    poses = [pose for pose in run.path if pose.stamp >= SETTLED]
    gaps = [_gap(run, pose) for pose in poses]
    left = [_is_left(run, pose) for pose in poses]
    share = sum(NEAR <= gap <= FAR and not other for gap, other in zip(gaps, left, strict=True)) / len(gaps)
    if share < SHARE:
        if sum(left) > len(left) / 2:
            raise Missed(
                "a robot with the wall on its right",
                f"the nearest wall on its left, for {sum(left) / len(left):.0%} of the time",
                "Look to the right, at ranges[270], and steer by what is there.",
                picture="path",
            )
        other = 1.0 - share - sum(not NEAR <= gap <= FAR for gap in gaps) / len(gaps)
        near, far = sum(gap < NEAR for gap in gaps), sum(gap > FAR for gap in gaps)
        hint = (
            "Turn a little to the left when the wall on the right is nearer than 0.5 m, and do so before "
            "it is 0.3 m: is angular.z positive then, and large enough?"
            if near > far
            else "Turn a little to the right when the wall on the right is further than 0.5 m: it must "
            "not get lost."
        )
        raise Missed(
            f"{SHARE:.0%} of the time at {NEAR:g} m to {FAR:g} m from the nearest wall",
            f"{share:.0%} of the time; {near / len(gaps):.0%} nearer, {far / len(gaps):.0%} further away"
            + (f", {other:.0%} with a wall on its left" if other >= 0.05 else ""),
            hint,
            credit=share * 0.8 if share >= 0.5 else 0.0,
            picture="path",
        )


@wall.check(4, after=goes_round)
def touches_nothing(run: Recording) -> None:
    """It touches nothing."""
    keeps_clear(
        run, "Before a corner the wall ahead counts: stop, and turn left, when it is nearer than 0.6 m."
    )


def _gap(run: Recording, pose: Pose) -> float:
    """The distance to the nearest of the room's walls, m."""
    return _nearest(run, pose)[0]


def _is_left(run: Recording, pose: Pose) -> bool:
    """Whether the nearest of the room's walls is on the robot's left, and not rather ahead or behind."""
    return math.sin(_nearest(run, pose)[1] - pose.yaw) > 0.5


def _nearest(run: Recording, pose: Pose) -> tuple[float, float]:
    """How far (m) the nearest of the room's walls is, and in which direction (rad, in the map)."""
    left, low, right, top = run.world.bounds
    gaps = pose.x - left, right - pose.x, pose.y - low, top - pose.y
    return min(zip(gaps, (math.pi, 0.0, -math.pi / 2, math.pi / 2), strict=True))


def _why_not_round(run: Recording) -> str:
    """The usual reasons for not getting round."""
    first = run.contacts[0] if run.contacts else None
    infinite = refused_command(run)
    if infinite and (first is None or first.side != "front"):
        return f"{infinite} Look to the right, at ranges[270], and steer so that it stays 0.5 m away."
    if first:
        return (
            f"It touched a {first.what} at {first.stamp:.3g} s, with its {first.side} side. When the wall "
            "ahead is nearer than 0.6 m, stop and turn left until it is free again."
        )
    gap = statistics.median(_gap(run, pose) for pose in run.path)
    if not NEAR <= gap <= FAR:
        return f"Most of the time it is {gap:.2f} m from the wall. Steer so that it is 0.5 m."
    left, low, right, top = run.world.bounds
    middle = (left + right) / 2, (low + top) / 2
    bearings = [math.atan2(pose.y - middle[1], pose.x - middle[0]) for pose in run.path]
    around = sum(math.remainder(b - a, math.tau) for a, b in itertools.pairwise(bearings))
    if around < -math.pi / 2:
        return "It goes round the other way. The wall should be on its right: at -90 degrees, ranges[270]."
    if travelled(run) < 10.0:
        return "It is too slow, or stands at times: the way is about 13 m, so drive at 0.2 m/s or more."
    return (
        "Two rules: turn left when the wall ahead is near; else steer so that the wall on the right stays "
        "at 0.5 m."
    )
