"""How far the goal is, and in which direction, from the odometry."""

import math
from collections.abc import Callable
from typing import NamedTuple

from grader.checks import Missed, lasts, publishes, series
from grader.companions.blind_drivers import Wanderer
from grader.exercise import Exercise
from grader.geometry import Pose2D
from grader.responses import EDGE
from grader.variants import Variants
from sim.evidence import Recording, Seconds

GOAL = (5.0, 5.0)

Formula = Callable[[Pose2D], float]


class Value(NamedTuple):
    """A value that the node published, and the last three poses of the odometry until then.

    Three, because a node may publish a little later.
    """

    stamp: Seconds
    value: float
    poses: list[Pose2D]

    def fits(self, formula: Formula, tolerance: float, modulo: float = math.inf) -> bool:
        """Return whether it is what the formula gives."""
        return math.isfinite(self.value) and any(
            abs(math.remainder(self.value - formula(pose), modulo)) <= tolerance for pose in self.poses
        )


compass = Exercise("compass", "Distance and bearing", world="yard", seconds=20, companions=[Wanderer],
                   seeds=(1, 2), variants=Variants(
    {"distance": ("/goal/distance", "/target/distance", "/goal/range"),
     "bearing": ("/goal/bearing", "/target/bearing", "/goal/angle")},
    texts=("{distance}", "{bearing}"),
))


def _distance(pose: Pose2D) -> float:
    return math.dist(GOAL, pose[:2])


def _direction(pose: Pose2D) -> float:
    return math.atan2(GOAL[1] - pose.y, GOAL[0] - pose.x)


def _bearing(pose: Pose2D) -> float:
    return math.remainder(_direction(pose) - pose.yaw, math.tau)


def _all_are(formula: Formula, tolerance: float) -> Callable[..., bool]:
    """The cause of a miss: all values are what a wrong formula gives."""
    return lambda run, answers: all(answer.fits(formula, tolerance) for answer in answers)


@compass.check(2)
def publishes_both(run: Recording) -> None:
    """The node publishes Float64 messages on /goal/distance and on /goal/bearing."""
    for topic in (compass.drawn.distance, compass.drawn.bearing):
        publishes(run, topic, "std_msgs/msg/Float64", at_least=20)


@compass.check(4, after=publishes_both, guess={
    "math.hypot takes the differences to the goal: math.hypot(goal x - x, goal y - y).":
        _all_are(lambda pose: math.hypot(*pose[:2]), 0.05),
    "The distance along x plus the distance along y is too long: use math.hypot.":
        _all_are(lambda pose: abs(GOAL[0] - pose.x) + abs(GOAL[1] - pose.y), 0.05),
    "The square root is missing: math.hypot(dx, dy) includes it.":
        _all_are(lambda pose: _distance(pose) ** 2, 0.05),
    "This is the bearing: return the distance first, then the bearing.": _all_are(_bearing, 0.05),
    "Print x, y and yaw in the callback, and work one case out by hand.": lambda run, answers: True,
})
def publishes_the_distance(run: Recording) -> None:
    """/goal/distance is the distance from the robot to (5, 5), in meters, within 5 cm."""
    topic = compass.drawn.distance
    _agrees(_answers(run, topic), _distance, 0.05, "m")
    lasts(run, topic)


@compass.check(6, after=publishes_both, hints={
    "It is off by whole turns: math.remainder(angle, math.tau) wraps it to -pi..pi.":
        lambda run, answers: _is_right_but_for_turns(answers)
}, guess={
    "This is the direction of the goal in the world; subtract the robot's yaw.": _all_are(_direction, 0.1),
    "The sign is wrong: take the goal's direction minus the robot's yaw, so that left is positive.":
        _all_are(lambda pose: -_bearing(pose), 0.1),
    "The unit is rad, not degrees.": _all_are(lambda pose: math.degrees(_bearing(pose)), 0.1),
    "This is the distance: return the distance first, then the bearing.": _all_are(_distance, 0.1),
    "It points away from the goal: dx and dy are the goal minus the robot.":
        _all_are(lambda pose: math.remainder(_bearing(pose) + math.pi, math.tau), 0.1),
    "A whole turn is math.tau: math.remainder(angle, math.pi) removes half turns, too.":
        _all_are(lambda pose: math.remainder(_bearing(pose), math.pi), 0.1),
    "math.atan2 takes dy first, then dx.":
        _all_are(lambda pose: math.remainder(math.pi / 2 - _direction(pose) - pose.yaw, math.tau), 0.1),
    "orientation.z isn't an angle: yaw = 2 * math.atan2(orientation.z, orientation.w).":
        _all_are(lambda pose: math.remainder(_direction(pose) - math.sin(pose.yaw / 2), math.tau), 0.1),
    "Print x, y and yaw in the callback, and work one case out by hand.": lambda run, answers: True,
})
def publishes_the_bearing(run: Recording) -> None:
    """/goal/bearing is how far the robot must turn to face (5, 5): -pi to pi rad, positive to the left."""
    topic = compass.drawn.bearing
    answers = _answers(run, topic)
    _agrees(answers, _bearing, 0.1, "rad", credit=0.5 if _is_right_but_for_turns(answers) else 0.0)
    lasts(run, topic)


def _agrees(answers: list[Value], right: Formula, tolerance: float, unit: str, credit: float = 0.0) -> None:
    wrong = [answer for answer in answers if not answer.fits(right, tolerance)]
    if wrong:
        stamp, value, poses = wrong[0]
        x, y, yaw = poses[-1]
        expected = f"{right(poses[-1]):.3g} {unit} from ({x:.2f}, {y:.2f}) m with yaw {yaw:.2f} rad"
        saw = f"{value:.3g} at {stamp:.3g} s; {len(wrong)} of {len(answers)} are wrong"
        raise Missed(expected, saw, credit=credit, about=(answers,))


def _is_right_but_for_turns(answers: list[Value]) -> bool:
    return all(answer.fits(_bearing, 0.1, math.tau) for answer in answers)


def _answers(run: Recording, topic: str) -> list[Value]:
    poses = [(row.stamp, Pose2D.from_message(row.message.pose.pose)) for row in run.messages("/odom")]
    found, known = [], 1
    for stamp, value in series(run, topic, "data"):
        while known < len(poses) and poses[known][0] <= stamp + EDGE:
            known += 1
        found.append(Value(stamp, value, [pose for _, pose in poses[max(known - 3, 0) : known]]))
    return found
