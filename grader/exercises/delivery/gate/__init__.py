"""Control drives to a place, and a gate decides whether it may."""

import itertools
import math
from collections.abc import Callable
from typing import NamedTuple

from grader.checks import Missed, publishes, rate, subscribes
from grader.checks.motion import length
from grader.exercise import Exercise
from grader.exercises.delivery.gate.faulty_perception import GOAL, PEOPLE, POSE, partners
from grader.geometry import Point, Pose2D
from grader.responses import Window, from_course, from_student, last_before, top_speed
from grader.variants import Variants
from grader.worlds.warehouses import floor_of
from sim import Network
from sim.evidence import Recording, Seconds, since_start

__all__ = ["gate", "partners"]

OUT, TWIST = "/cmd_vel", "geometry_msgs/msg/Twist"
BRAKING = 0.6  # s until a robot stands, a timer of 10 Hz included
STILL = 0.03  # m/s
SLOW, MARGIN = 0.2, 0.04  # m/s
STARTS = 4.0  # s, within which the robot drives on
STEP = 0.05  # s
OLD, NEAR, WIDE = 0.5, 1.5, 2.5  # s; m: stands, drives slowly
NO_STOPS = ("When the robot may not drive, your node publishes nothing, and the robot keeps its last "
            "command: "
            "publish zeros then, every time drive is called.")
LOOK_OUT = "Compute the distance to each of self.people before each command."
ABOUT = 0.05  # m; what is nearer to a limit is on neither side
LATE = 0.19  # s; the most that a message takes from the robot to the student's laptop
BUSY = Network(links={
    ("robot", "laptop"): Network(delay=LATE - 0.09, jitter=0.09),
    ("laptop", "robot"): Network(delay=0.02, jitter=0.01),
})

gate = Exercise("gate", "Control, behind a gate", world=floor_of, seconds=52, companions=partners,
                network=BUSY, seeds=(2,), variants=Variants(
    {"rate": (10.0, 20.0), "period": (0.1, 0.05), "often": ("ten", "twenty")},
    texts=("{often} times a second", "create_timer({period}, self.drive)"),
))


@gate.check(2, guess="Leave the subscriptions unchanged, and publish at the end of drive.")
def has_its_endpoints(run: Recording) -> None:
    """The node subscribes to /robot_pose, /people and /goal_pose, and publishes Twist on /cmd_vel."""
    for topic in (POSE, PEOPLE, GOAL):
        subscribes(run, topic)
    publishes(run, OUT, TWIST, at_least=10)


@gate.check(5, after=has_its_endpoints)
def arrives(run: Recording) -> None:
    """The robot gets to the first place it is sent to, and touches no one."""
    touched = [contact for contact in run.contacts if contact.what == "person"]
    if touched:
        saw = f"a person touched at {touched[0].stamp:.3g} s"
        raise Missed("no one touched", saw, LOOK_OUT, picture="path", unsafe=True)
    places = [place for _, place in _goals(run)]
    if len(set(places)) < 2:
        aim = "Drive along self.way with steer, as fast as the gate allows, and stop when the goal is near."
        saw = f"the wrong place: the robot ends at {run.path[-1].x:.2f}, {run.path[-1].y:.2f}"
        expected = f"the robot standing still at {places[0][0]:.2f}, {places[0][1]:.2f}"
        raise Missed(expected, saw, guess=aim, picture="path")


@gate.check(4, after=arrives)
def stands_near_people(run: Recording) -> None:
    """It stands still while a person is reported within 1.5 m."""
    _require_at_most(run, STILL, _close, LOOK_OUT, unsafe=True)


@gate.check(2, after=arrives)
def slow_about_people(run: Recording) -> None:
    """It drives no faster than 0.2 m/s while a person is within 2.5 m."""
    hint = "Use two limits for the nearest person: within 1.5 m the speed is 0, within 2.5 m it is 0.2."
    _require_at_most(run, SLOW + MARGIN, _farther, hint)


@gate.check(4, after=arrives)
def stands_without_new_messages(run: Recording) -> None:
    """It stops when /robot_pose or /people is older than 0.5 s, by the stamps."""
    hint = "Store the stamps of both, not when they arrived, and compare the older one with the clock."
    _require_at_most(run, STILL, _old, hint, unsafe=True)


@gate.check(3, after=arrives)
def publishes_stops_and_goes_on(run: Recording) -> None:
    """It always publishes ten times a second, and drives on when it is allowed to."""
    try:
        rate(run, OUT, gate.drawn.rate, tolerance=0.15)
    except Missed as missed:
        missed.hint = missed.hint if _publishes_while_it_stands(run) else NO_STOPS
        raise
    changes = [stamp for (_, before), (stamp, after) in itertools.pairwise(_goals(run)) if before != after]
    for window, why in _windows(run, _allowed):
        if window.end - window.begin < STARTS or any(map(window.contains, changes)):
            continue
        if length(window.rows(run.path)) < 0.1:
            expected = f"a robot that drives from {window.begin:.3g} s on, because {why}"
            hint = "Check the gate again every time: whatever stopped the robot earlier no longer counts."
            raise Missed(expected, f"it stood until {window.end:.3g} s", hint, picture="path")


def _publishes_while_it_stands(run: Recording) -> bool:
    """Return whether the student's program publishes anything when the robot has to stand."""
    windows = [window for cause in (_close, _old) for window, _ in _windows(run, cause)]
    inner = [Window(window.begin + BRAKING / 2, window.end - BRAKING / 2) for window in windows]
    return any(window.rows(from_student(run, OUT)) for window in inner)


def _goals(run: Recording) -> list[tuple[Seconds, Point]]:
    rows = from_course(run, GOAL, what=f"places on {GOAL}")
    return [(row.stamp, Pose2D.from_message(row.message.pose)[:2]) for row in rows]


class KnownState(NamedTuple):
    """The state that control certainly knows at a time: what has crossed the network by then.

    age: of the older of the two messages, by their stamps (s). why: why it is old. near: how far the nearest
    reported person was (m).
    """

    stamp: Seconds
    age: Seconds
    why: str
    near: float


def _moments(run: Recording) -> list[KnownState]:
    """From the first messages on both topics on."""
    rows = {topic: from_course(run, topic, at_least=0) for topic in (POSE, PEOPLE)}
    if not all(rows.values()):
        return []
    begin = max(found[0].stamp for found in rows.values())
    times = [begin + index * STEP for index in range(int((run.ended.stamp - begin) / STEP))]
    found = []
    for now in times:
        pose, people = (last_before(rows[topic], now - LATE) or rows[topic][0] for topic in (POSE, PEOPLE))
        ages = [now - since_start(row.message.header.stamp) for row in (pose, people)]
        here = Pose2D.from_message(pose.message.pose)
        places = [Pose2D.from_message(one)[:2] for one in people.message.poses]
        near = min((math.dist(here[:2], place) for place in places), default=math.inf)
        why = f"the stamps on {POSE if ages[0] > OLD else PEOPLE} were old"
        if now - pose.stamp >= OLD:
            why = "there were no messages"
        elif now - people.stamp > OLD:
            why = f"nothing arrived on {PEOPLE}"
        found.append(KnownState(now, max(ages), why, near))
    return found


def _old(moment: KnownState) -> str:
    return moment.why if moment.age > OLD else ""


def _close(moment: KnownState) -> str:
    return "a person was within 1.5 m" if moment.near < NEAR - ABOUT and moment.age < OLD else ""


def _farther(moment: KnownState) -> str:
    inside = NEAR + ABOUT < moment.near < WIDE - ABOUT and moment.age < OLD
    return "a person was within 2.5 m" if inside else ""


def _allowed(moment: KnownState) -> str:
    return "nothing was in the way" if moment.near > NEAR + ABOUT and moment.age < OLD - 0.1 else ""


def _windows(run: Recording, cause: Callable[[KnownState], str]) -> list[tuple[Window, str]]:
    """The times in which one of the causes above holds all along, and its text."""
    groups = itertools.groupby(_moments(run), key=cause)
    begins = [(why, next(moments).stamp) for why, moments in groups]
    ends = [begin for _, begin in begins[1:]] + [run.ended.stamp]
    return [(Window(begin, end), why) for (why, begin), end in zip(begins, ends, strict=False) if why]


def _require_at_most(run: Recording, speed: float, cause: Callable[[KnownState], str], hint: str,
                     unsafe: bool = False) -> None:
    """Raises Missed where the robot is faster than that (m/s) although a cause has held for a while."""
    found = [row for row in _windows(run, cause) if row[0].end - row[0].begin > BRAKING + LATE]
    if not found:
        hint = "Drive at 0.5 m/s while the gate is open: the faults come while the robot drives."
        raise Missed("a robot that drives when the fault comes", "none that drives fast enough", hint)
    for whole, why in found:
        # New messages may arrive at once, and the timer that drives may fire after them.
        window = Window(whole.begin + BRAKING, run.ended.stamp).before(whole.end - LATE - STEP)
        top = top_speed(window.rows(run.path))
        if top.linear > speed:
            expected = f"at most {speed:.2g} m/s from {window.begin:.3g} s on, because {why}"
            saw = f"{top.linear:.2f} m/s at {top.stamp:.3g} s"
            hint = hint if _publishes_while_it_stands(run) else NO_STOPS
            raise Missed(expected, saw, hint, picture="path", unsafe=unsafe)
