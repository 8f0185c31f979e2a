"""Turn away from what is in the way."""

import math

from grader.checks import Missed, keeps_clear, otherwise, publishes, series, traveled, until_a_touch
from grader.exercise import Exercise
from grader.worlds.rooms import furnished_room
from sim.evidence import Recording

FAR, LONG = 1.0, 4.0  # meters: from the start, and of the path
BESIDE = ("It hit something with its side. Check a wider sector, at least 30 degrees to each side, because "
          "the robot is 20 cm wide. And while it turns, linear.x should be 0.")
AHEAD = ("Look ahead in every scan: the rays from -30 to 30 degrees are at the two ends of msg.ranges. "
         "When one of them is shorter than 0.5 m, turn on the spot, with linear.x at 0.")

avoid = Exercise("avoid", "Turn until the way is clear", world=furnished_room, seconds=60, seeds=(1, 2))


def _why_it_hits(run: Recording) -> str:
    return BESIDE if run.contacts[0].side in ("left", "right") else AHEAD


def _turning(run: Recording) -> float:
    """The share of commands that turn the robot."""
    turns = [bool(0.05 < abs(turn) < math.inf) for _, turn in series(run, "/cmd_vel", "angular.z")]
    return sum(turns) / len(turns)


@avoid.check(2, guess="Drive ahead with linear.x; when something is close ahead, turn with angular.z.")
def wanders_off(run: Recording) -> None:
    """The robot moves, with commands on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")
    first = run.path[0]
    if all(math.dist(first[1:], pose[1:]) < 0.05 for pose in run.path):
        raise Missed("a robot that drives or turns", "a robot that stands still", picture="path")


@avoid.check(3, after=wanders_off, hints={
    "It pushes against something. {why}":
        lambda run, way: run.contacts and {"why": _why_it_hits(run)},
    "It turns most of the time. Turn only while the distance ahead is less than 0.5 m: is the comparison "
    "the right way round? Look only ahead, not all around: a wall beside the robot stays close however "
    "long it turns. And turn one way until the path is clear, not back and "
    "forth.": lambda run, way: _turning(run) > 0.6,
    "It never turns: when something is close ahead, set angular.z until the path is clear.":
        lambda run, way: _turning(run) == 0,
    "It stands still, or creeps. Once the path ahead is clear, drive on at 0.2 m/s or more.": otherwise,
})
def drives_on(run: Recording) -> None:
    """It does not get stuck: in 60 s it drives 4 m or more."""
    way = traveled(until_a_touch(run))
    if way < LONG:
        credit = 0.7 * way / LONG if way > 1.0 else 0.0
        raise Missed(f"a path of {LONG:g} m", f"{way:.2f} m", credit=credit, picture="path", about=(way,))


@avoid.check(5, after=drives_on)
def hits_nothing(run: Recording) -> None:
    """It touches nothing for 60 s."""
    try:
        keeps_clear(run)
    except Missed as missed:
        missed.hint = _why_it_hits(run)
        missed.credit = 0.5 * min(run.contacts[0].stamp / run.seconds, 1.0)
        raise


@avoid.check(4, after=drives_on,
             guess="Drive straight while the path ahead is clear, and turn only when it isn't.")
def gets_about(run: Recording) -> None:
    """It gets around: at some point it is 1 m or more from where it started."""
    start = run.path[0]
    far = max(math.dist(start[1:3], pose[1:3]) for pose in until_a_touch(run).path)
    if far < FAR:
        expected = f"the robot {FAR:g} m or more from its start"
        raise Missed(expected, f"at most {far:.2f} m", picture="path")
