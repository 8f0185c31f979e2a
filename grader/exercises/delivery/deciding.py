"""An exercise on the state machine: fetch, deliver, charge, rest."""

from __future__ import annotations

import math

from grader.checks import Missed, hinting, publishes, rate
from grader.exercise import Exercise
from grader.exercises.delivery.desk import Situation, desk, situations
from sim.evidence import Message, Recording, Seconds

GOAL, STATE = "/goal_pose", "/state"
LATE = 1.2  # s until a decision that comes twice a second has to hold
SAME = 0.02  # m
PAST = "Hear /orders with KEPT, and keep orders by their id: a later message replaces an earlier one."
SILENT = "Publish both each time the timer calls, also where nothing has changed, and wait for nothing."

decide = Exercise("decide", "Decide: what next?", seconds=39, companions=desk, seeds=(1, 2))


@decide.check(2)
def decides(run: Recording) -> None:
    """The node publishes PoseStamped messages on /goal_pose and String messages on /state."""
    with hinting(guess="The dock and the orders were published before your node began: hear them with KEPT."):
        publishes(run, GOAL, "geometry_msgs/msg/PoseStamped")
        publishes(run, STATE, "std_msgs/msg/String")


@decide.check(2, after=decides)
def knows_the_past(run: Recording) -> None:
    """It knows what was published before it began: the last word on each order counts."""
    _compare(run, "past", PAST)


@decide.check(1, after=knows_the_past)
def says_in_which_frame(run: Recording) -> None:
    """Where to go is said in the frame map, as /dock_pose and the orders do."""
    for goal in _said(run, GOAL, 0.0, math.inf):
        frame = goal.message.header.frame_id
        if frame != "map":
            hint = "Publish the pose of the order or the dock as it came: header.frame_id is in it."
            raise Missed(f"the frame “map” on {GOAL}", f"“{frame}” at {goal.stamp:.3g} s", hint)


@decide.check(2, after=knows_the_past)
def never_waits(run: Recording) -> None:
    """It says where to go twice a second, without a pause."""
    for topic in (GOAL, STATE):
        rate(run, topic, 2.0, tolerance=0.15)


@decide.check(4, after=knows_the_past)
def delivers_first(run: Recording) -> None:
    """Whoever carries something delivers it, whatever else is wanted."""
    _compare(run, "delivers", "Look for an order that is PICKED_UP before you look at anything else.")


@decide.check(4, after=knows_the_past)
def charges(run: Recording) -> None:
    """It charges below 30 %, then until 80 %, and not in between."""
    hint = "Two limits: below 0.3 it begins; below 0.8 it goes on, if the last state was charge."
    _compare(run, "charges", hint)


@decide.check(4, after=knows_the_past)
def gives_up(run: Recording) -> None:
    """It gives up what is over, and what can't be made in time any more."""
    hint = "Fetch an order only while it is WAITING and has more time left than it takes; ask each time."
    _compare(run, "gives up", hint)


@decide.check(3, after=knows_the_past)
def keeps_to_one(run: Recording) -> None:
    """It takes the most urgent order, and then stays with the one that it began."""
    hint = "While the order that it began can be made, none takes its place; else the earliest deadline."
    _compare(run, "keeps", hint)


def _compare(run: Recording, about: str, hint: str) -> None:
    """Raises Missed at the first situation that tries this rule and in which something else was said."""
    for one in situations(run.seed, about):
        begin, end = one.begin + LATE, min(one.end, run.ended.stamp)
        goals, states = (_said(run, topic, begin, end) for topic in (GOAL, STATE))
        expected = f"“{one.state}” and {_place(one.place)} from {begin:.3g} s on, as {one.told}"
        if not (goals and states):
            saw = f"no word from {begin:.3g} s to {one.end:.3g} s"
            raise Missed(expected, saw, SILENT, picture="topics")
        for state, goal in zip(states, goals, strict=False):
            if state.message.data != one.state or not _is_there(goal, one):
                there = goal.message.pose.position
                saw = f"“{state.message.data}” and {_place((there.x, there.y))} at {goal.stamp:.3g} s"
                raise Missed(expected, saw, hint, picture="topics")


def _said(run: Recording, topic: str, begin: Seconds, end: Seconds) -> list[Message]:
    return [heard for heard in run.messages(topic) if not heard.from_course and begin <= heard.stamp < end]


def _is_there(goal: Message, one: Situation) -> bool:
    there = goal.message.pose.position
    return math.dist((there.x, there.y), one.place) < SAME


def _place(place: tuple[float, float]) -> str:
    return f"({place[0]:.2f}, {place[1]:.2f})"
