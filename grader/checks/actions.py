"""Measures over actions: which goals are accepted, how they end, what comes on the way, who is canceled."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from typing import Any

from grader.checks.check import Missed
from grader.checks.ends import declared
from grader.checks.fields import differing, message_text, read, words
from grader.checks.no_data import no_data
from grader.checks.topics import longest_pause
from grader.geometry.near import is_near
from sim.evidence import (
    CANCEL_REJECTED,
    CANCEL_REQUESTED,
    REJECTED,
    Endpoint,
    Goal,
    Recording,
    Seconds,
    stamps,
)
from sim.evidence import rate as mean_rate

Picks = Callable[[Goal], bool]


def _all(goal: Goal) -> bool:
    return True


def serves_action(recording: Recording, action: str, type: str = "") -> list[Endpoint]:
    """The servers of an action, e.g. "/fibonacci" of type "example_interfaces/action/Fibonacci".

    Raises Missed when there is none, or one of another type.
    """
    expected = f"an action server {action}" + (f" of type {type}" if type else "")
    return declared(recording, "action server", action, type, expected)


def sends_goals(recording: Recording, action: str, type: str = "", *, at_least: int = 1) -> list[Goal]:
    """The student's goals for an action, at least so many. Raises Missed without client, type or goals."""
    expected = f"an action client for {action}" + (f" of type {type}" if type else "")
    declared(recording, "action client", action, type, expected)
    sent = [goal for goal in recording.goals_of(action) if goal.requested is not None]
    found = [goal for goal in sent if not goal.requested_by_course]
    if len(found) < at_least:
        many = f"a goal for {action}" if at_least == 1 else f"{at_least} or more goals for {action}"
        saw = f"only {len(found)} in {recording.ended.stamp:.3g} s" if found else "a client, but no goal"
        raise Missed(many, saw)
    return found


def accepts(recording: Recording, action: str, *, where: Picks = _all) -> list[Goal]:
    """Every goal is accepted. where: picks the goals.

    Raises Missed for the first that isn't, and without a server; without such goals as `no_data`.
    """
    return _decides(recording, action, where, "accepted", lambda goal: goal.at("accepted") is not None)


def rejects(recording: Recording, action: str, *, where: Picks = _all) -> list[Goal]:
    """Every goal is rejected; otherwise as `accepts`."""
    return _decides(recording, action, where, REJECTED, lambda goal: goal.status == REJECTED)


def _decides(recording: Recording, action: str, where: Picks, word: str, right: Picks) -> list[Goal]:
    goals = _goals(recording, action, where)
    wrong = [goal for goal in goals if not right(goal)]
    if wrong:
        raise Missed(f"{_named(wrong[0])} {word}", state(wrong[0]), credit=1 - len(wrong) / len(goals))
    return goals


def finishes(
    recording: Recording,
    action: str,
    status: str = "succeeded",
    right: Callable[[Any], Mapping[str, Any]] = lambda request: {},
    *,
    within: Seconds | None = None,
    where: Picks = _all,
) -> list[Goal]:
    """Every goal ends with this status, in time, and with the right fields in its result.

    status: succeeded, canceled or aborted. right: gives the fields of the right result and their values for
    a goal's request; other fields may be anything. within: seconds since the goal was accepted; None for any.
    Raises Missed for the first goal that doesn't, with credit for those that do; without goals as `no_data`.
    """
    goals = _goals(recording, action, where)
    misses = [miss for goal in goals if (miss := _unfinished(goal, status, right, within))]
    if misses:
        raise Missed(*misses[0], credit=1 - len(misses) / len(goals))
    return goals


def _unfinished(
    goal: Goal, status: str, right: Callable[[Any], Mapping[str, Any]], within: Seconds | None
) -> tuple[str, str] | None:
    ended, in_time = goal.at(status), f" within {within:g} s" if within is not None else ""
    if ended is None:
        return f"{_named(goal)} {status}{in_time}", state(goal)
    took = ended - (goal.at("accepted") or 0.0)
    if within is not None and took > within + 1e-9:
        return f"{_named(goal)} {status}{in_time}", f"{status} after {took:.3g} s"
    values = right(goal.request)
    if values and goal.result is None:
        return f"{words(values)} as the result of {_named(goal)}", "no result"
    wrong = differing(goal.result, values)
    if not wrong:
        return None
    saw = ", ".join(f"{name}={read(goal.result, name)!r}" for name in wrong)
    return f"{words({name: values[name] for name in wrong})} as the result of {_named(goal)}", saw


def gives_feedback(
    recording: Recording,
    action: str,
    hz: float = 0.0,
    *,
    tolerance: float = 0.1,
    rising: str = "",
    falling: str = "",
    where: Picks = _all,
) -> list[Goal]:
    """Every goal that is executed gives feedback until it ends.

    hz: its rate in Hz of simulated time, to within `tolerance` as a fraction; 0 for any rate.
    rising, falling: a field that never goes back while a goal is executed, such as "distance_remaining".
    Raises Missed for the first goal that doesn't; without such goals as `no_data`.
    """
    goals = [goal for goal in _goals(recording, action, where) if goal.at("executing") is not None]
    if not goals:
        raise Missed(f"feedback on a goal for {action}", "no goal was executed")
    for goal in goals:
        if not goal.feedback:
            hint = "In the loop of the execute callback: goal_handle.publish_feedback(feedback)."
            raise Missed(f"feedback on {_named(goal)}", "none", hint)
        if hz:
            _keeps_rate(recording, goal, hz, tolerance)
        for field, sign in ((rising, 1), (falling, -1)):
            if field:
                _goes_one_way(goal, field, sign)
    return goals


def _keeps_rate(recording: Recording, goal: Goal, hz: float, tolerance: float) -> None:
    expected = f"feedback on {_named(goal)} at {hz:.4g} Hz, within {tolerance:.0%}"
    moments = stamps(goal.feedback)
    end = recording.ended.stamp if goal.ended is None else goal.ended
    edges = [goal.at("executing") or 0.0, *moments, end]
    pause, since = longest_pause(edges)
    measured = mean_rate(moments)
    if measured and not is_near(measured, hz, tolerance * hz):
        raise Missed(expected, f"{measured:.4g} Hz ({len(moments)} messages)")
    if pause > 2.5 / hz:
        raise Missed(expected, f"none for {pause:.3g} s, from {since:.3g} s on")


def _goes_one_way(goal: Goal, field: str, sign: int) -> None:
    values = [(received.stamp, read(received.message, field)) for received in goal.feedback]
    for (_, before), (stamp, after) in itertools.pairwise(values):
        if not sign * after >= sign * before:  # so that NaN doesn't pass
            saw = f"{after!r} after {before!r} at {stamp:.3g} s"
            raise Missed(f"{field} only {'rising' if sign > 0 else 'falling'} in the feedback", saw)


def cancels(recording: Recording, action: str, *, within: Seconds = 1.0, where: Picks = _all) -> list[Goal]:
    """Every goal that a client wants to cancel ends as canceled within so many seconds of that.

    Raises Missed for the first that doesn't; when no goal was to be canceled as `no_data`.
    """
    asked = [goal for goal in _goals(recording, action, where) if goal.at(CANCEL_REQUESTED) is not None]
    if not asked:
        speakers = recording.graph.ends("action client", action)
        raise no_data(recording, f"goals for {action} that are canceled", "none", speakers)
    for goal in asked:
        began, ended = goal.at(CANCEL_REQUESTED) or 0.0, goal.at("canceled")
        if ended is None or ended - began > within + 1e-9:
            expected = f"{_named(goal)} canceled within {within:g} s of the request at {began:.3g} s"
            late = ended is not None and f"canceled after {ended - began:.3g} s"
            raise Missed(expected, late or f"{_refused(goal)}{state(goal)}")
    return asked


def _refused(goal: Goal) -> str:
    refused = goal.at(CANCEL_REJECTED)
    return f"the request refused at {refused:.3g} s; " if refused is not None else ""


def _goals(recording: Recording, action: str, where: Picks) -> list[Goal]:
    goals = [goal for goal in recording.goals_of(action) if where(goal)]
    if not goals:
        serves_action(recording, action)
        saw = f"{len(recording.goals_of(action))}, but none like that"
        raise no_data(
            recording, f"goals for {action} that fit", saw, recording.graph.ends("action client", action)
        )
    return goals


def _named(goal: Goal) -> str:
    asked = "" if goal.requested is None else f" at {goal.requested:.3g} s"
    return f"the goal {goal.action} ({message_text(goal.request)}){asked}"


def state(goal: Goal) -> str:
    """Return how far a goal came, in words: "succeeded at 4 s"."""
    if not goal.status:
        return "no decision on it" if goal.server else "no server received the goal"
    if goal.over:
        return f"{goal.status} at {goal.at(goal.status):.3g} s"
    return f"still {goal.status} at the end"
