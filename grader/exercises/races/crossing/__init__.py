"""A client of an action whose state is that of the server, whatever crosses on the way."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from grader.checks import Missed, hinting, otherwise, publishes, sends_goals
from grader.exercise import Exercise, Scenario
from grader.exercises.races.crossing.drive_server import (
    ACTION,
    COMMANDS,
    CROSSING,
    DIED,
    LONGEST,
    NEWER,
    PLAIN,
    RESTART,
    SCENARIOS,
    SPEED,
    driving,
    trusting_yard,
)
from grader.geometry.near import is_near
from grader.responses import EDGE
from grader.worlds.trusting import trusting
from sim.evidence import CANCEL_REQUESTED, ENDINGS, Goal, Message, Recording, Seconds

__all__ = ["crossing", "driving", "trusting_yard"]

DRIVING, LOST = "driving", "lost"
GRACE, LOST_AFTER, SENT = 0.3, 1.0, 0.08  # s: after a result; after the server has died; after a distance
STANDS_AFTER, STILL = 0.7, 0.02  # s after a goal's end; m
STEP = 0.1  # s between the moments that are judged

crossing = Exercise("crossing", "Both ends agree", scenarios=[
    Scenario(trusting("yard"), LONGEST[name], number, functools.partial(driving, name), name=name)
    for number, name in enumerate(SCENARIOS, 1)
])  # fmt: skip

SILENCE = ("Silence is no stop: this robot obeys its last command until the next one. Publish a Twist() of "
           "zeros when {when}.")  # fmt: skip
TOO_EARLY = ("Those zeros came too early: the server drives until it has seen the cancel request. Publish "
             "them when the result has arrived.")  # fmt: skip
STOP_FORGOTTEN = ("The stop came before the server had accepted the newest goal: it had no handle yet. "
                  "Remember the stop, and cancel that goal in on_response.")  # fmt: skip


class Change(NamedTuple):
    """A state of the newest goal.

    stamp: since when it has the state, or, for "driving", was requested. known: when a client knows it.
    """

    stamp: Seconds
    state: str
    known: Seconds
    why: str


@crossing.check(1)
def sends_a_goal_for_each_distance(run: Recording) -> list[Goal]:
    """For each message on /distance, the node sends one goal to /drive_on_heading at once."""
    wanted = run.received("/distance")
    with hinting("In on_distance: goal.target.x = msg.data, goal.speed = 0.25, and send_goal_async(goal)."):
        goals = sends_goals(run, ACTION, "nav2_msgs/action/DriveOnHeading")
        for number, row in enumerate(wanted):
            sent = [goal.request for goal in _sent_at_once(goals, row)]
            if [(one.target.x, one.speed) for one in sent] != [(row.message.data, np.float32(SPEED))]:
                saw = "; ".join(f"target.x={one.target.x:g}, speed={one.speed:g}" for one in sent) or "none"
                goal = f"target.x={row.message.data:g} and speed={SPEED:g}"
                expected = f"one goal at {row.stamp:.3g} s, with {goal}"
                raise Missed(expected, saw, credit=number / len(wanted), measured=goals)
    return goals


HINTS = {
    "The server sends no feedback before it has accepted a goal, and none for 0.3 s before a result: be "
    "patient.":
        lambda run, change, saw: saw == LOST,
    "The server is still there, but drives no more: it may have started again and know nothing of this goal. "
    "Each piece of feedback is a sign of life: if none arrives for 0.6 s, the goal is lost.":
        lambda run, change, saw: change.state == LOST,
    "That is the result of an older goal. Give each goal a number, and ignore what arrives for any but the "
    "newest.":
        lambda run, change, saw: saw == "aborted",
    "The goal had already succeeded when your request arrived, so the server refused it. Only the result "
    "says how a goal ended.":
        lambda run, change, saw: change.state == "succeeded" and saw == "canceled",
    "A canceled goal ends with its result, not with the request: publish the state in on_result.":
        lambda run, change, saw: saw == "canceled",
    "The newest goal has ended, and your node doesn't know: request its result with get_result_async().":
        lambda run, change, saw: saw == DRIVING,
    "Publish the state when it changes: “driving” in on_response, and in on_result what the status says.":
        lambda run, change, saw: not saw,
    "The status of the result is a number, GoalStatus.STATUS_...: publish what it says.":
        otherwise,
}  # fmt: skip


@crossing.check(2, after=sends_a_goal_for_each_distance, only=PLAIN, hints=HINTS)
def agrees_if_nothing_crosses(run: Recording, goals: list[Goal]) -> None:
    """/state is “driving” while a goal is executed, and then “succeeded” or “canceled”."""
    _agrees(run, goals)


@crossing.check(3, after=sends_a_goal_for_each_distance, only=CROSSING, hints=HINTS)
def agrees_if_a_stop_crosses(run: Recording, goals: list[Goal]) -> None:
    """/state is right if a stop comes before the goal is accepted, or when it is about to succeed."""
    _stopped_early(run, goals)
    _agrees(run, goals)


@crossing.check(3, after=sends_a_goal_for_each_distance, only=NEWER, hints=HINTS)
def agrees_about_the_newest(run: Recording, goals: list[Goal]) -> None:
    """If a newer distance replaces an older one, /state is that of the newest goal."""
    _sent_all(run, goals, "Send a newer goal without waiting: the server aborts the older one by itself.")
    _stopped_early(run, goals)
    _agrees(run, goals)


@crossing.check(2, after=sends_a_goal_for_each_distance, only=RESTART, hints=HINTS)
def notices_a_restart(run: Recording, goals: list[Goal]) -> None:
    """Within a second of the server's death /state is “lost”; the next goal is as usual."""
    _agrees(run, goals)
    _sent_all(run, goals, "After a loss the next distance is a new goal: forget the one that was lost.")


@crossing.check(3, after=sends_a_goal_for_each_distance)
def stops_the_robot(run: Recording, goals: list[Goal]) -> None:
    """Whenever a goal has ended or is lost, the robot stands still until the next one."""
    changes = list(_changes(run, goals))
    both = zip(changes, _ends(run, goals, changes), strict=True)
    stops = [(change, end - STEP) for change, end in both if change.state != DRIVING]
    if not stops:
        raise Missed("a goal that ends", "none")
    for change, end in stops:
        begin = change.known - GRACE + STANDS_AFTER
        moved = run.pose_at(end).x - run.pose_at(begin).x
        if end > begin and not is_near(moved, 0.0, STILL):
            expected = f"a robot that stands still from {begin:.3g} s on ({change.why})"
            when = "the goal is lost" if change.state == LOST else "the result has arrived"
            hint = SILENCE.format(when=when)
            around = run.during(change.stamp - 1.0, change.stamp).messages(COMMANDS)
            if change.state != LOST and around:
                hint = TOO_EARLY
            raise Missed(expected, f"it drove {moved:.2f} m further", hint, picture="path", unsafe=True)


def _sent_at_once(goals: list[Goal], row: Message) -> list[Goal]:
    return [goal for goal in goals if 0.0 <= _requested(goal) - row.stamp + EDGE <= SENT]


def _sent_all(run: Recording, goals: list[Goal], hint: str) -> None:
    """Raise Missed unless each distance was sent as a goal at once."""
    unsent = [row.stamp for row in run.received("/distance") if not _sent_at_once(goals, row)]
    if unsent:
        raise Missed(f"a goal at {unsent[0]:.3g} s", "none", hint)


def _agrees(run: Recording, goals: list[Goal]) -> None:
    """Raise Missed unless /state is that of the newest goal, whenever a client can know it."""
    rows = publishes(run, "/state", "std_msgs/msg/String")
    changes = list(_changes(run, goals))
    for number, (change, end) in enumerate(zip(changes, _ends(run, goals, changes), strict=True)):
        for moment in np.arange(change.known, end - EDGE, STEP):
            before = [row.message.data for row in rows if row.stamp <= moment]
            saw = before[-1] if before else ""
            if saw != change.state:
                expected = f"“{change.state}” on /state at {moment:.3g} s ({change.why})"
                credit = 0.5 * number / len(changes)
                shown = f"“{saw}”" if saw else "nothing so far"
                raise Missed(expected, shown, about=(change, saw), credit=credit, picture="topics")
    if not any(change.state != DRIVING for change in changes):
        raise Missed("goals that end", "none")
    _claims_no_end(rows, goals)


def _claims_no_end(rows: list[Message], goals: list[Goal]) -> None:
    """Raise Missed if /state has an end that the newest goal didn't have yet."""
    for row in rows:
        newest = max((goal for goal in goals if _requested(goal) <= row.stamp), key=_requested, default=None)
        accepted = newest.at("accepted") if newest is not None else None
        if newest is None or accepted is None or row.message.data not in ENDINGS:
            continue
        if row.stamp >= accepted + STEP and (newest.at(row.message.data) or math.inf) > row.stamp + EDGE:
            change = Change(row.stamp, newest.status, row.stamp, "")
            expected = f"“{DRIVING}” on /state at {row.stamp:.3g} s: the goal hasn't ended"
            raise Missed(expected, f"“{row.message.data}”", about=(change, row.message.data))


def _ends(run: Recording, goals: list[Goal], changes: list[Change]) -> list[Seconds]:
    """Until when each change holds: the next one, or the next request of a goal."""
    nexts = [*(change.stamp for change in changes[1:]), run.ended.stamp]
    requests = [[_requested(goal) for goal in goals if _requested(goal) > change.stamp] for change in changes]
    return [min([end, *later]) for end, later in zip(nexts, requests, strict=True)]


def _stopped_early(run: Recording, goals: list[Goal]) -> None:
    """Raise Missed if a stop that came before its goal was accepted was forgotten."""
    for row in run.received("/stop"):
        sent = [goal for goal in goals if _requested(goal) <= row.stamp]
        newest = max(sent, key=_requested, default=None)
        accepted = newest.at("accepted") if newest is not None else None
        if newest is None or accepted is None or accepted < row.stamp:
            continue
        if newest.at(CANCEL_REQUESTED) is None:
            goal = f"the goal of {_requested(newest):.3g} s"
            expected = f"a request to cancel {goal}, after the stop at {row.stamp:.3g} s"
            raise Missed(expected, "none", STOP_FORGOTTEN)


def _requested(goal: Goal) -> Seconds:
    return goal.requested or 0.0


def _changes(run: Recording, goals: list[Goal]) -> Iterator[Change]:
    """The states of the newest goal, in their order."""
    deaths = [line.stamp for line in run.logs if line.text == DIED and run.is_course_node(line.node)]
    ordered = sorted(goals, key=_requested)
    newer = [*map(_requested, ordered[1:]), math.inf]
    for goal, until in zip(ordered, newer, strict=True):
        began, ended = goal.at("accepted"), goal.ended or math.inf
        death = next((stamp for stamp in deaths if _requested(goal) < stamp < min(until, ended)), None)
        if began is not None and began < until:
            yield Change(_requested(goal), DRIVING, began + GRACE, f"its goal was accepted at {began:.3g} s")
        if death is not None:
            yield Change(death, LOST, death + LOST_AFTER, f"the server died at {death:.3g} s")
        elif ended < until:
            known = (goal.received or ended + 0.4) + GRACE
            how = goal.status if goal.status == "succeeded" else f"was {goal.status}"
            yield Change(ended, goal.status, known, f"its goal {how} at {ended:.3g} s")
