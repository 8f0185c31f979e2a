"""Exercises on reactive control: stop before a wall, and turn away from what is in the way."""

from __future__ import annotations

import math

from grader.checks import (
    Missed,
    keeps_clear,
    publishes,
    series,
    stands_still,
    travelled,
    until_a_touch,
)
from grader.exercise import Exercise
from grader.worlds.rooms import furnished_room, hall
from sim.evidence import Recording

TWIST = "geometry_msgs/msg/Twist"
STOP_AT = 1.0  # metres before the wall

stop = Exercise("stop", "Stop before the wall", world=hall, seconds=30, seeds=(1, 2))


@stop.check(2)
def sets_off(run: Recording) -> None:
    """The robot drives ahead, with commands on /cmd_vel."""
    publishes(run, "/cmd_vel", TWIST)
    far = max(pose.x for pose in run.path)
    if far < 0.5:
        raise Missed(
            "a robot that drives ahead while nothing is nearer than 1 m",
            f"it comes {far:.2f} m far",
            _why_it_stands(run),
            picture="path",
        )


@stop.check(4, after=sets_off)
def stops_in_time(run: Recording) -> None:
    """It stops when the wall is nearer than 1 m, and at once."""
    gap = run.world.bounds[2] - run.path[-1].x
    if run.contacts:
        raise Missed(
            "a stop before the wall",
            f"the robot drove into it at {run.contacts[0].stamp:.3g} s",
            "Every scan decides anew: ahead while min(msg.ranges) is above 1.0, else 0.0. Is the "
            "comparison the right way round?",
            picture="path",
            unsafe=True,
        )
    if not STOP_AT - 0.15 <= gap <= STOP_AT + 0.05:
        raise Missed(
            "a stop about 0.95 m before the wall: the limit is 1 m, and braking takes a few centimetres",
            f"it ends {gap:.2f} m before the wall",
            _why_it_stops_there(gap),
            picture="path",
        )


@stop.check(2, after=stops_in_time)
def says_stop(run: Recording) -> None:
    """It stays there, and goes on sending zeros."""
    stands_still(run)
    stamp, speed = series(run, "/cmd_vel", "linear.x")[-1]
    if speed or run.ended.stamp - stamp > 0.5:
        raise Missed(
            "zeros on /cmd_vel as long as the wall is near",
            f"{speed:g} m/s as the last command, at {stamp:.3g} s",
            "It stood still only because the robot stops by itself without commands. Publish in every "
            "callback, a Twist() of zeros, too.",
            picture="topics",
        )


def _why_it_stands(run: Recording) -> str:
    speeds = [speed for _, speed in series(run, "/cmd_vel", "linear.x")]
    if any(speed < 0 for speed in speeds):
        return "linear.x is negative: that is backwards."
    if any(speeds):
        return "The commands stop too early, or come too rarely: publish one in every callback."
    if any(turn for _, turn in series(run, "/cmd_vel", "angular.z")):
        return "It turns on the spot: the speed ahead is linear.x; angular.z is how fast it turns."
    return (
        "linear.x is 0 in all commands. At the start the nearest wall is 2 m away: what does your line "
        "say then?"
    )


def _why_it_stops_there(gap: float) -> str:
    if gap > STOP_AT:
        return "It stops too early. Compare the nearest distance, min(msg.ranges), with 1.0 (metres)."
    if gap > STOP_AT - 0.25:
        return "That is late for a robot at 0.3 m/s: is a zero sent at once, in the same callback?"
    return "It stops too late. Compare the nearest distance, min(msg.ranges), with 1.0 (metres)."


FAR, LONG = 1.0, 4.0  # metres: from the start, and of the way

avoid = Exercise("avoid", "Turn until it is free", world=furnished_room, seconds=60, seeds=(1, 2))


@avoid.check(2)
def wanders_off(run: Recording) -> None:
    """The robot moves, with commands on /cmd_vel."""
    publishes(run, "/cmd_vel", TWIST)
    first = run.path[0]
    if all(math.dist(first[1:], pose[1:]) < 0.05 for pose in run.path):
        guess = "Ahead with linear.x, or, where something is near ahead, a turn: angular.z."
        raise Missed("a robot that drives or turns", "a robot that stands", guess=guess, picture="path")


@avoid.check(3, after=wanders_off)
def drives_on(run: Recording) -> None:
    """It does not get stuck: in 60 s it comes 4 m far, or more."""
    way = travelled(until_a_touch(run))
    if way < LONG:
        credit = 0.7 * way / LONG if way > 1.0 else 0.0
        hint = _why_it_is_stuck(run)
        raise Missed(f"a way of {LONG:g} m", f"{way:.2f} m", hint, credit=credit, picture="path")


@avoid.check(5, after=drives_on)
def hits_nothing(run: Recording) -> None:
    """It touches nothing for 60 s."""
    try:
        keeps_clear(run)
    except Missed as missed:
        first = run.contacts[0]
        missed.hint = _why_it_hits(first.side)
        missed.credit = 0.5 * min(first.stamp / run.seconds, 1.0)
        raise


@avoid.check(
    4, after=drives_on, guess="Drive straight on while it is free ahead, and turn only when it is not."
)
def gets_about(run: Recording) -> None:
    """It gets about: at some time it is 1 m from where it started, or further."""
    start = run.path[0]
    far = max(math.dist((start.x, start.y), (pose.x, pose.y)) for pose in until_a_touch(run).path)
    if far < FAR:
        expected = f"the robot {FAR:g} m from its start, or further"
        raise Missed(expected, f"at most {far:.2f} m", picture="path")


def _why_it_is_stuck(run: Recording) -> str:
    """The usual reasons for a short way."""
    turns = [abs(turn) > 0.05 for _, turn in series(run, "/cmd_vel", "angular.z")]
    if run.contacts:
        return f"It pushes against something. {_why_it_hits(run.contacts[0].side)}"
    if sum(turns) > 0.6 * len(turns):
        return (
            "It turns most of the time. Turn only where the distance ahead is less than 0.5 m: which way "
            "round is the comparison? Look ahead only, not all round: a wall beside the robot stays near, "
            "however long it turns. And turn one way until it is free, not to and fro."
        )
    if not any(turns):
        return "It never turns: where something is near ahead, set angular.z, until it is free."
    return "It stands, or creeps. Once it is free ahead, drive on, at 0.2 m/s or more."


def _why_it_hits(side: str) -> str:
    if side in ("left", "right"):
        return (
            "It hit something with its side. Look in a wider sector, at least 30 degrees to each side, "
            "for the robot is 20 cm wide. And while it turns, linear.x should be 0."
        )
    return (
        "Look ahead in every scan: the rays from -30 to 30 degrees lie at both ends of msg.ranges. When "
        "one of them is nearer than 0.5 m, turn on the spot: linear.x is 0 then."
    )
