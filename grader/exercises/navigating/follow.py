"""Drive along a path with pure pursuit."""

import math
from functools import partial
from typing import Any

import numpy as np

from grader.checks import Missed, has_no_contacts, publishes, series, stands_still, tenths, until_a_touch
from grader.checks.motion import distances_to_line, ends_with_a_stop, goal_in, is_hopeless, stood_still
from grader.companions.goals import Planner
from grader.companions.maps import Localization, made_for
from grader.exercise import Exercise, Scenario
from grader.geometry import Point, Pose2D
from grader.geometry.ground import drivable
from grader.responses import stands_without_transforms
from grader.worlds.rooms import world_of
from grader.worlds.trusting import trusting
from sim.evidence import Recording, Seconds

NEAR = 0.15  # meters from the path's end
# Meters from the path: pure pursuit stays within 9 cm in all worlds, and within 7 cm in a maze. With half the
# curvature it swings out of a maze's corners by 13 cm or more.
OFF = 0.12
LOST = 0.4  # meters from the path: what the robot passes farther away is not covered
CORNERS = ("If it cuts a corner, look less far ahead. If it swings wide, it turns too little: curvature = "
           "2 * sin(bearing) / distance, and turn on the spot while the bearing is above 1 rad to either "
           "side.")
FASTEST = 1.0  # m/s that a student may want
AHEAD = 0.3  # meters: how far ahead of the robot the assignment steers for
NEXT = 1.0  # meters of the path in which its next point is looked for
ENDS = 4.0, 6.0  # s: between these the localization ends in another run
LATE = 2.0  # s after its start the localization first publishes, in one of the runs: after the path


def _settled(run: Recording) -> bool:
    """Return whether the robot has stood at the goal for 2 s, or will not get there."""
    at_goal = math.dist(goal_in(run), run.path[-1][1:3]) < NEAR
    return (at_goal and stood_still(run, 2.0)) or is_hopeless(run, patience=10.0)


def _scenario(kind: str, seed: int, late: Seconds = 0.0) -> Scenario:
    def companions(seed: int) -> list[Any]:
        world = world_of(kind, seed)
        return [made_for(Planner, world=world), made_for(Localization, start=world.start, late=late)]

    return Scenario(lambda seed: world_of(kind, seed), 90, seed, companions, _settled, name=kind)


def _loses_it(seed: int) -> list[Any]:
    world = world_of("maze", seed)
    return [made_for(Planner, world=world), made_for(Localization, start=world.start, ends=ENDS)]



follow = Exercise("follow", "Along the path", scenarios=[
    _scenario("clutter", 2), _scenario("maze", 1, LATE),
    Scenario(trusting(partial(world_of, "maze")), 12, 3, _loses_it, name="lost"),
], may_end=True)
KNOWN = "clutter", "maze"  # where it knows to the end where it is


def _turns(run: Recording) -> list[float]:
    return [value for _, value in series(run, "/cmd_vel", "angular.z")]


def _speeds(run: Recording) -> list[float]:
    return [value for _, value in series(run, "/cmd_vel", "linear.x")]


def _is_slow(run: Recording) -> bool:
    return max(_speeds(run)) <= FASTEST


@follow.check(1)
def sends_commands(run: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")


@follow.check(6, after=sends_commands, only=KNOWN, guess={
    "It only turns on the spot. A positive bearing is to the left, and so is a positive angular.z.":
        lambda run: not any(_speeds(run)) and any(_turns(run)),
    "The robot was never commanded to drive ahead: linear.x is the speed, such as 0.4 m/s.":
        lambda run: not any(_speeds(run)),
    "The robot was never commanded to turn: set angular.z to speed times curvature.":
        lambda run: not any(_turns(run)) and _is_slow(run),
    "It hardly turns: the curvature is 2 * sin(bearing) / distance, with the bearing in rad.":
        lambda run: max(map(abs, _turns(run))) < 0.05 and _is_slow(run),
    "The speed changes all the time, and the turn doesn't: return the speed first, then the turn.":
        lambda run: len(set(_turns(run))) <= 4 and len(set(_speeds(run))) > 16,
    "The speed is {speed:.3g} m/s: return the speed first, then the turn; on the spot the speed is 0.":
        lambda run: not _is_slow(run) and {"speed": max(_speeds(run))},
    "It steers as if /odom, or the transform from odom to base_link, were the robot's pose in the map. "
    "That pose is relative to where it started: apply the transform from map to odom as well.":
        lambda run: _trusts_odometry_alone(run),
    "It drove into a {what} at {stamp:.3g} s: the picture shows where. {corners}":
        lambda run: run.contacts and run.contacts[0]._asdict() | {"corners": CORNERS},
    "It was commanded to stop before the end: stop only within 0.1 m of the last point.":
        lambda run: _speeds(run)[-1] == 0.0 and not _turns(run)[-1],
    "Plot the lookahead point: it has to be on the path, a little ahead of the robot.": lambda run: True,
})
def drives_along(run: Recording) -> None:
    """The robot drives along the path to its end."""
    covered, whole = _covered(run)
    if whole - covered > NEAR:
        end = run.path[-1]
        expected = f"the whole path, {whole:.1f} m"
        saw = f"{covered:.1f} m of it; the robot ends at ({end.x:.2f}, {end.y:.2f}) m"
        raise Missed(expected, saw, credit=tenths(0.8 * covered / whole), picture="path")


@follow.check(4, after=drives_along, only=KNOWN)
def keeps_near(run: Recording) -> None:
    """On the way the robot stays within 12 cm of the path, and touches nothing."""
    has_no_contacts(run, CORNERS)
    off = distances_to_line(np.array([pose[1:3] for pose in run.path]), _line(run))
    worst = int(np.argmax(off))
    if off[worst] > OFF:
        pose = run.path[worst]
        saw = f"{off[worst]:.3f} m off at {pose.stamp:.3g} s, at ({pose.x:.2f}, {pose.y:.2f}) m"
        credit = 0.5 if off[worst] < 2 * OFF else 0.0
        raise Missed(f"the robot within {OFF} m of the path", saw, CORNERS, credit=credit, picture="path")


@follow.check(3, after=drives_along, only=KNOWN)
def stops_at_its_end(run: Recording) -> None:
    """At the end of the path the robot stands still, within 15 cm of it."""
    left = math.dist(_line(run)[-1], run.path[-1][1:3])
    if left > NEAR:
        guess = "When the robot is within 0.1 m of the last point, publish a Twist() of zeros."
        expected = f"the robot within {NEAR} m of the path's end"
        raise Missed(expected, f"{left:.2f} m away", guess=guess, picture="path")
    stands_still(run)
    ends_with_a_stop(run)


@follow.check(2, after=sends_commands, only="lost")
def stops_when_it_is_lost(run: Recording) -> None:
    """When no new transforms from map to odom arrive, the robot stops within 1.5 s."""
    stands_without_transforms(run, "odom", "from map to odom", "First let the robot drive along the path.")


def _line(run: Recording) -> tuple[Point, ...]:
    return drivable(run.world)


def _covered(run: Recording) -> tuple[float, float]:
    """Return how far along the path the robot came, point after point without short cuts; and its length."""
    line, reached = np.array(_line(run)), 0
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
    for pose in run.path:
        ahead = int(np.searchsorted(along, along[reached] + NEXT))
        gaps = np.hypot(*(line[reached : ahead + 1] - pose[1:3]).T)
        near = np.nonzero(gaps <= gaps.min() + 1e-9)[0][-1]
        if gaps[near] < LOST:
            reached += int(near)
    return float(along[reached]), float(along[-1])


def _trusts_odometry_alone(run: Recording) -> bool:
    """Return whether it turns to where the path ahead would be, were the robot where its odometry has it."""
    fits_map, fits_odometry = [], []
    assert run.world is not None  # a maze
    line, (x0, y0, yaw0) = np.array(_line(run)), run.world.start
    from_start = Pose2D(0.0, 0.0, -yaw0)
    for stamp, turn in series(until_a_touch(run), "/cmd_vel", "angular.z"):
        _, x, y, yaw = run.pose_at(stamp)
        if 0.1 < abs(turn) < math.inf:
            odometry = Pose2D(*from_start.point((x - x0, y - y0)), yaw - yaw0)
            fits_map.append(turn * _bearing_ahead(line, Pose2D(x, y, yaw)) > 0)
            fits_odometry.append(turn * _bearing_ahead(line, odometry) > 0)
    return bool(fits_map) and np.mean(fits_odometry) > 0.9 > 0.7 > np.mean(fits_map)


def _bearing_ahead(line: np.ndarray, pose: Pose2D) -> float:
    """The direction of the path ahead of a robot, in rad to its left."""
    distances = np.hypot(*(line - pose[:2]).T)
    nearest = int(distances.argmin())
    far = np.flatnonzero(distances[nearest:] >= AHEAD)
    x, y = line[nearest:][far[0] if len(far) else -1]
    return math.remainder(math.atan2(y - pose.y, x - pose.x) - pose.yaw, math.tau)
