"""Exercises without a map: how far and where the goal is, and to drive there."""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable, Sequence

from grader.checks import Missed, arrives, check, publishes, series, stands_still, travelled
from grader.exercise import Exercise
from grader.exercises.advice import advising
from grader.exercises.navigator.partners import Wanderer
from grader.exercises.navigator.progress import tenths
from sim.recording import Pose, Recording, Seconds

GOAL = (5.0, 5.0)
FLOAT, TWIST = "std_msgs/msg/Float64", "geometry_msgs/msg/Twist"
DISTANCE, BEARING = "/goal/distance", "/goal/bearing"

Spot = tuple[float, float, float]  # x, y (m) and yaw (rad), by the odometry
Formula = Callable[[Spot], float]


@check(points=2)
def tells_both(recording: Recording) -> None:
    """The node publishes Float64 messages on /goal/distance and on /goal/bearing."""
    with advising(recording, "Publish both in the callback of /odom: msg = Float64(data=...)."):
        for topic in (DISTANCE, BEARING):
            publishes(recording, topic, FLOAT, at_least=20)


@check(points=4, after=tells_both)
def tells_the_distance(recording: Recording) -> None:
    """/goal/distance is the distance from the robot to (5, 5), in metres, within 5 cm."""
    usual = {
        "math.hypot takes the differences to the goal: math.hypot(goal x - x, goal y - y).": (
            lambda spot: math.hypot(*spot[:2])
        ),
        "A distance along both axes, one after the other, is too long: use math.hypot.": (
            lambda spot: abs(GOAL[0] - spot[0]) + abs(GOAL[1] - spot[1])
        ),
        "The square root is missing: math.hypot(dx, dy) does it all.": (
            lambda spot: math.dist(GOAL, spot[:2]) ** 2
        ),
        "This is the bearing: first comes the distance, then the bearing.": _bearing,
    }
    _agrees(recording, DISTANCE, lambda spot: math.dist(GOAL, spot[:2]), 0.05, "m", usual)


@check(points=6, after=tells_both)
def tells_the_bearing(recording: Recording) -> None:
    """/goal/bearing is how far the robot must turn to face (5, 5): -pi to pi rad, positive to the left."""
    usual = {
        "This is the direction of the goal in the world; take the robot's yaw away.": _direction,
        "The sign is wrong: the goal's direction minus the robot's yaw, so that left is positive.": (
            lambda spot: -_bearing(spot)
        ),
        "The unit is rad, not degrees.": lambda spot: math.degrees(_bearing(spot)),
        "This is the distance: first comes the distance, then the bearing.": (
            lambda spot: math.dist(GOAL, spot[:2])
        ),
        "It points away from the goal: dx and dy are the goal minus the robot.": (
            lambda spot: math.remainder(_bearing(spot) + math.pi, math.tau)
        ),
        "A whole turn is math.tau: math.remainder(angle, math.pi) takes half turns away, too.": (
            lambda spot: math.remainder(_bearing(spot), math.pi)
        ),
        "math.atan2 takes dy first, then dx.": (
            lambda spot: math.remainder(math.pi / 2 - _direction(spot) - spot[2], math.tau)
        ),
        "orientation.z is no angle: yaw = 2 * math.atan2(orientation.z, orientation.w).": (
            lambda spot: math.remainder(_direction(spot) - math.sin(spot[2] / 2), math.tau)
        ),
        "math.atan(dy / dx) and the like lose half of the directions: use math.atan2(dy, dx).": (
            lambda spot: math.atan((GOAL[1] - spot[1]) / ((GOAL[0] - spot[0]) or 1e-9)) - spot[2]
        ),
    }
    _agrees(recording, BEARING, _bearing, 0.1, "rad", usual)


def _direction(spot: Spot) -> float:
    return math.atan2(GOAL[1] - spot[1], GOAL[0] - spot[0])


def _bearing(spot: Spot) -> float:
    return math.remainder(_direction(spot) - spot[2], math.tau)


def _agrees(
    recording: Recording, topic: str, right: Formula, tolerance: float, unit: str, usual: dict[str, Formula]
) -> None:
    """All values of a topic fit where the robot was by its odometry then, or just before."""
    spots = odometry(recording)
    told = [(stamp, value, latest(spots, stamp)) for stamp, value in series(recording, topic, "data")]
    wrong = [one for one in told if not _fits(one, right, tolerance)]
    if not wrong:
        return
    stamp, value, near = wrong[0]
    x, y, yaw = near[-1]
    saw = f"{value:.3g} at {stamp:.3g} s; {len(wrong)} of {len(told)} are wrong"
    expected = f"{right(near[-1]):.3g} {unit} from ({x:.2f}, {y:.2f}) m with yaw {yaw:.2f} rad"
    turns = [one for one in told if _fits(one, right, tolerance, math.tau)]
    if unit == "rad" and len(turns) == len(told):
        hint = "It is right but for whole turns: math.remainder(angle, math.tau) brings it to -pi..pi."
        raise Missed(expected, saw, hint, credit=0.5)
    fitting = (words for words, other in usual.items() if all(_fits(one, other, tolerance) for one in told))
    with advising(recording, next(fitting, "Print x, y and yaw in the callback, and work one out by hand.")):
        raise Missed(expected, saw)


def _fits(
    one: tuple[Seconds, float, Sequence[Spot]], right: Formula, tolerance: float, modulo: float = math.inf
) -> bool:
    _, value, near = one
    return any(abs(math.remainder(value - right(spot), modulo)) <= tolerance for spot in near)


def odometry(recording: Recording) -> list[tuple[Seconds, Spot]]:
    """Where the robot was by its odometry, with stamps."""
    found = []
    for heard in recording.messages("/odom"):
        pose = heard.message.pose.pose
        yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        found.append((heard.stamp, (pose.position.x, pose.position.y, math.remainder(yaw, math.tau))))
    return found


def latest(spots: list[tuple[Seconds, Spot]], stamp: Seconds) -> list[Spot]:
    """The last three known at that time: a node may answer a little later."""
    index = bisect.bisect_right(spots, stamp + 1e-6, key=lambda spot: spot[0])
    return [spot for _, spot in spots[max(index - 3, 0) : max(index, 1)]]


compass = Exercise(
    "compass",
    "Distance and bearing",
    [tells_both, tells_the_distance, tells_the_bearing],
    world="yard",
    seconds=20,
    companions=[Wanderer],
    seeds=(1, 2),
)


WAY, NEAR, STOP = math.dist((0.0, 0.0), GOAL), 0.2, 0.1  # metres


@check(points=1)
def sends_velocities(recording: Recording) -> None:
    """The node publishes Twist messages on /cmd_vel."""
    publishes(recording, "/cmd_vel", TWIST)


@check(points=7, after=sends_velocities)
def gets_there(recording: Recording) -> None:
    """The robot comes within 20 cm of (5, 5)."""
    nearest = _nearest(recording)
    left = math.dist(GOAL, (nearest.x, nearest.y))
    if left > NEAR:
        with advising(recording, _driving_hint(recording)):
            raise Missed(
                "the robot within 0.2 m of (5, 5) m",
                f"{left:.2f} m away at the nearest, at {nearest.stamp:.3g} s",
                credit=tenths(0.8 * (1 - left / WAY)),
                picture="path",
            )


@check(points=4, after=gets_there)
def stays_there(recording: Recording) -> None:
    """In the end the robot stands still, within 20 cm of (5, 5)."""
    left = math.dist(GOAL, _nearest(recording)[1:3])
    hint = "Nearer than 0.1 m is near enough: then send a Twist() with zeros."
    if left > STOP:
        hint = f"It goes past the goal, {left:.2f} m beside it: turn more for the same bearing, or go slower."
    with advising(recording, hint if left <= NEAR else "First get there."):
        arrives(recording, GOAL, tolerance=NEAR)
    stands_still(recording)


@check(points=2, after=gets_there)
def goes_straight(recording: Recording) -> None:
    """The way to the goal is no more than 15 % longer than the straight line."""
    reached = [math.dist(GOAL, (pose.x, pose.y)) <= NEAR for pose in recording.path]
    if not any(reached):
        raise Missed("a way to (5, 5)", "the robot did not get there", "First get there.", picture="path")
    way = travelled(Recording(path=recording.path[: reached.index(True) + 1]))
    if way > 1.15 * WAY:
        hint = "Turn towards the goal first; while the bearing is large, drive slowly or not at all."
        raise Missed(f"a way of {1.15 * WAY:.2f} m or less", f"{way:.2f} m", hint, picture="path")


def _nearest(recording: Recording) -> Pose:
    return min(recording.path, key=lambda pose: math.dist(GOAL, (pose.x, pose.y)))


def _driving_hint(recording: Recording) -> str:
    """The usual reasons for not getting there."""
    turns = [value for _, value in series(recording, "/cmd_vel", "angular.z")]
    speeds = [value for _, value in series(recording, "/cmd_vel", "linear.x")]
    if not any(turns) and any(speeds):
        return "The robot never turned: angular.z follows the bearing, such as 2.0 * bearing."
    if not any(speeds) and not any(turns):
        return "All commands are zeros; they should be only nearer than 0.1 m: is it > or <?"
    if not any(speeds):
        return "The robot was never told to go ahead: set linear.x (m/s)."
    if max(speeds) <= 0:
        return "It was told to go backwards: a positive linear.x goes ahead."
    if recording.path[-1].stamp - recording.messages("/cmd_vel")[-1].stamp > 1:
        return "The commands stopped too early. Send one with each /odom, until the robot is there."
    way, end = travelled(recording), recording.path[-1]
    if way < 0.5:
        return "It turns and turns. A positive bearing is to the left, and so is a positive angular.z."
    if speeds[-1] == 0.0:
        return f"It was told to stop at ({end.x:.2f}, {end.y:.2f}) m: linear.x became 0 there."
    if way > WAY:
        return "It drives past the goal. Turn more for the same bearing, and go slowly while that is large."
    return f"It came {way:.2f} m far in {recording.ended.stamp:.0f} s: 0.3 m/s or more is a good speed."


drive = Exercise(
    "drive",
    "To the goal",
    [sends_velocities, gets_there, stays_there, goes_straight],
    world="yard",
    seconds=60,
)
