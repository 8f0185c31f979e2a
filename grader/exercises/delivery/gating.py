"""An exercise on control: it drives to a place, and a gate decides whether it may."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

from grader.checks import Missed, hinting, publishes, rate, subscribes, travelled
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.delivery.floor import flat
from grader.exercises.delivery.known import Moment, about, allowed, close, old, spans
from grader.exercises.delivery.partners import GOAL, PEOPLE, POSE, floor_of, partners
from sim.evidence import Recording, Seconds

OUT, TWIST = "/cmd_vel", "geometry_msgs/msg/Twist"
BRAKING = 0.6  # s until a robot stands, a timer of 10 Hz included
STILL = 0.03  # m/s
SLOW, MARGIN = 0.2, 0.04  # m/s
STARTS = 4.0  # s, within which the robot drives on

gate = Exercise("gate", "Control, behind a gate", world=floor_of, seconds=45, companions=partners, seeds=(2,))


@gate.check(2)
def listens(run: Recording) -> None:
    """The node hears /robot_pose, /people and /goal_pose, and publishes Twist messages on /cmd_vel."""
    with hinting(guess="Leave the subscriptions as they are, and publish at the end of drive."):
        for topic in (POSE, PEOPLE, GOAL):
            subscribes(run, topic)
        publishes(run, OUT, TWIST, at_least=10)


@gate.check(5, after=listens)
def arrives(run: Recording) -> None:
    """The robot comes to the first place that it is sent to, and touches nobody."""
    touched = [contact for contact in run.contacts if contact.what == "person"]
    if touched:
        hint = "Somebody walks there: before each command, ask whether the robot may move at all."
        saw = f"a person touched at {touched[0].stamp:.3g} s"
        raise Missed("nobody touched", saw, hint, picture="path", unsafe=True)
    places = [flat(heard.message.pose)[:2] for heard in run.messages(GOAL) if heard.from_course]
    if not places:
        raise no_data(run, f"places on {GOAL}", "none", run.graph.publishers(GOAL))
    if len(set(places)) < 2:
        guess = (
            "Drive along self.way with steer, as fast as the gate allows, and stand when the goal is near."
        )
        saw = f"another place, as the robot ends at {run.path[-1].x:.2f}, {run.path[-1].y:.2f}"
        expected = f"the robot standing at {places[0][0]:.2f}, {places[0][1]:.2f}"
        raise Missed(expected, saw, guess=guess, picture="path")


@gate.check(4, after=arrives)
def stands_near_people(run: Recording) -> None:
    """It stands while somebody is told of within 1.5 m."""
    _slower(run, close, STILL, "Ask for the distance to each of self.people before each command.", True)


@gate.check(2, after=arrives)
def slow_about_people(run: Recording) -> None:
    """It drives no faster than 0.2 m/s while somebody is within 2.5 m."""
    hint = "Two limits for the nearest person: within 1.5 m the speed is 0, within 2.5 m it is 0.2."
    _slower(run, about, SLOW + MARGIN, hint, False)


@gate.check(4, after=arrives)
def stands_without_news(run: Recording) -> None:
    """It stands when /robot_pose or /people is older than 0.5 s, by the stamps."""
    hint = "Keep the stamps of both, not when they came, and compare the older one with the clock."
    _slower(run, old, STILL, hint, True)


@gate.check(3, after=arrives)
def says_stop_and_goes_on(run: Recording) -> None:
    """It publishes ten times a second in every case, and drives on when it may."""
    with hinting("Publish in every call of drive: begin with an empty Twist, and fill it where it may move."):
        rate(run, OUT, 10.0, tolerance=0.15)
    goals = [(heard.stamp, flat(heard.message.pose)[:2]) for heard in run.messages(GOAL) if heard.from_course]
    changes = [stamp for (_, before), (stamp, after) in itertools.pairwise(goals) if before != after]
    for span in spans(run, allowed):
        if span.end - span.begin < STARTS or any(span.begin < stamp < span.end for stamp in changes):
            continue
        if travelled(run.during(span.begin, span.end)) < 0.1:
            expected = f"a robot that drives from {span.begin:.3g} s on, as {span.why}"
            hint = "The gate is asked anew each time: what stopped the robot before doesn't count any more."
            raise Missed(expected, f"it stood until {span.end:.3g} s", hint, picture="path")


def _slower(run: Recording, held: Callable[[Moment], str], most: float, hint: str, unsafe: bool) -> None:
    """Raises Missed where the robot is faster than that (m/s) although something has held for a while."""
    found = [span for span in spans(run, held) if span.end - span.begin > BRAKING]
    if not found:
        hint = "Drive at 0.5 m/s where nothing speaks against it: the faults come while the robot drives."
        raise Missed("a robot that drives when the fault comes", "none that drives fast enough", hint)
    for span in found:
        begin = span.begin + BRAKING
        speed, stamp = _fastest(run.during(begin, span.end))
        if speed > most:
            expected = f"at most {most:.2g} m/s from {begin:.3g} s on, as {span.why}"
            raise Missed(expected, f"{speed:.2f} m/s at {stamp:.3g} s", hint, picture="path", unsafe=unsafe)


def _fastest(part: Recording) -> tuple[float, Seconds]:
    pairs = itertools.pairwise(part.path)
    speeds = ((math.dist(a[1:3], b[1:3]) / (b.stamp - a.stamp), b.stamp) for a, b in pairs)
    return max(speeds, default=(0.0, part.begin))
