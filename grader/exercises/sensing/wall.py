"""A design exercise: follow the wall round a room."""

import itertools
import math
import statistics

from grader.checks import Missed, keeps_clear, otherwise, passes, publishes, traveled, until_a_touch
from grader.checks.motion import world_in
from grader.diagnosis.driving import refused_command
from grader.exercise import Exercise, Scenario
from grader.worlds.rooms import MARGIN, gallery, gallery_from_the_wall
from sim.evidence import Pose, Recording

NEAR, FAR = 0.3, 0.8  # meters from the wall
SETTLED = 3.0  # seconds
SHARE = 0.9  # of the time

wall = Exercise("wall", "Around the room, your way", scenarios=[
    Scenario(gallery, 90, 1),
    Scenario(gallery_from_the_wall, 90, 2),
])


def _nearest_wall(run: Recording, pose: Pose) -> tuple[float, float]:
    """Return how far (m) the nearest of the room's walls is, and in which direction (rad, in the map)."""
    left, low, right, top = world_in(run).bounds
    gaps = pose.x - left, right - pose.x, pose.y - low, top - pose.y
    return min(zip(gaps, (math.pi, 0.0, -math.pi / 2, math.pi / 2), strict=True))


def _goes_the_other_way(run: Recording) -> bool:
    left, low, right, top = world_in(run).bounds
    x, y = (left + right) / 2, (low + top) / 2
    bearings = [math.atan2(pose.y - y, pose.x - x) for pose in run.path]
    return sum(math.remainder(b - a, math.tau) for a, b in itertools.pairwise(bearings)) < -math.pi / 2


@wall.check(2, hints={
    "{command} -inf is a wall too close to be measured: max(0.0, distance) turns it into a number.":
        lambda run: (command := refused_command(run)) and {"command": command},
}, guess="While nothing is ahead, linear.x should be 0.2 or more.")
def leaves_the_start(run: Recording) -> None:
    """The robot drives ahead, with commands on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")
    if traveled(run) < 0.5:
        raise Missed("a robot that drives", f"a path of {traveled(run):.2f} m", picture="path")


@wall.check(4, after=leaves_the_start, hints={
    "{command} Look to the right, at ranges[270], and steer so that it stays 0.5 m away.":
        lambda run: (command := refused_command(run))
        and (not run.contacts or run.contacts[0].side != "front") and {"command": command},
    "It touched a {what} at {stamp:.3g} s, with its {side} side. Look at the replay just before that: what "
    "did the lidar see, and which part of your program should have reacted to it?":
        lambda run: run.contacts and run.contacts[0]._asdict(),
    "Most of the time it is {gap:.2f} m from the wall. Steer so that it is 0.5 m.":
        lambda run: (gap := statistics.median(_nearest_wall(run, pose)[0] for pose in run.path))
        and not NEAR <= gap <= FAR and {"gap": gap},
    "It goes around the other way. Keep the wall on its right, at -90 degrees: ranges[270].":
        _goes_the_other_way,
    "It is too slow, or stops at times: the path is about 13 m long, so drive at 0.2 m/s or more.":
        lambda run: traveled(run) < 10.0,
    "It doesn't come around. What does it do along a wall, and what in a corner? Which of the two does it do "
    "at the point where it leaves the wall?": lambda run: True,
})
def goes_round(run: Recording) -> None:
    """It goes around the room, with the wall on its right: past all four corners, within 90 s."""
    left, low, right, top = world_in(run).bounds
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
            f"{done} of them; then it never came within 0.6 m of the inside of the {list(corners)[done]} one",
            credit=max(0, done - 1) / (len(corners) - 1),  # one may be passed by chance
            picture="path",
        ) from None


@wall.check(8, after=goes_round, hints={
    "Look to the right, at ranges[270], and steer by that distance.": lambda run, left, near, far: left > 0.5,
    "Turn a little to the left when the wall on the right is closer than 0.5 m, before it is 0.3 m away: "
    "is angular.z positive then, and large enough?": lambda run, left, near, far: near > far,
    "Turn a little to the right when the wall on the right is farther than 0.5 m: don't lose "
    "it.": otherwise,
})
def keeps_the_distance(run: Recording) -> None:
    """It keeps 30 cm to 80 cm from the wall on its right, for nine tenths of the time or more."""
    rows = [(pose.yaw, *_nearest_wall(run, pose)) for pose in run.path if pose.stamp >= SETTLED]
    on_left = [math.sin(direction - yaw) > 0.5 for yaw, _, direction in rows]  # and not ahead or behind
    is_near, is_far = [gap < NEAR for _, gap, _ in rows], [gap > FAR for _, gap, _ in rows]
    wrong = [any(flags) for flags in zip(on_left, is_near, is_far, strict=True)]
    share = wrong.count(False) / len(rows)
    left, near, far = (flags.count(True) / len(rows) for flags in (on_left, is_near, is_far))
    if share >= SHARE:
        return
    if left > 0.5:
        expected = "a robot with the wall on its right"
        saw = f"the nearest wall on its left, for {left:.0%} of the time"
        raise Missed(expected, saw, picture="path", about=(left, near, far))
    other = 1.0 - share - near - far
    raise Missed(
        f"{SHARE:.0%} of the time at {NEAR:g} m to {FAR:g} m from the nearest wall",
        f"{share:.0%} of the time; {near:.0%} closer, {far:.0%} farther away"
        + (f", {other:.0%} with a wall on its left" if other >= 0.05 else ""),
        credit=share * 0.8 if share >= 0.5 else 0.0,
        picture="path",
        about=(left, near, far),
    )


@wall.check(4, after=goes_round)
def touches_nothing(run: Recording) -> None:
    """It touches nothing."""
    hint = "How far away is a wall ahead when your program reacts to it? Is that enough at your speed?"
    keeps_clear(run, hint)
