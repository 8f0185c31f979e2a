"""Goals of actions that don't end as they should: forgotten endings, and cancels that go unnoticed."""

from __future__ import annotations

import itertools

from sim.evidence import CANCEL_REJECTED, CANCEL_REQUESTED, Goal, Recording

# What rclpy warns of, and does all the same.
_NO_GOAL_RESPONSE = "did not return a GoalResponse type"
_LAST_MOMENT = 0.5  # s: what is requested so shortly before the end of a run may come to nothing
_ONE_STEP = 0.2  # s: between two looks at is_cancel_requested, where feedback doesn't show the steps
_NO_ENDING = "Goal state not set, assuming aborted"


def no_goal_response(recording: Recording) -> str:
    """A goal callback that returns something else than a GoalResponse."""
    if not _warned(recording, _NO_GOAL_RESPONSE):
        return ""
    return (
        "A goal callback returned something other than a GoalResponse, so the goal was rejected: return "
        "GoalResponse.ACCEPT or GoalResponse.REJECT."
    )


def no_ending(recording: Recording) -> str:
    """An execute callback that returns without saying how the goal ended."""
    goal = next((goal for goal in recording.goals if goal.status == "aborted"), None)
    if goal is None or not _warned(recording, _NO_ENDING):
        return ""
    return (
        f"The execute callback of {goal.action} returned without setting the goal's final state, which "
        "counts as aborted: call goal_handle.succeed() before you return the result."
    )


def cancel_ignored(recording: Recording) -> str:
    """A server that agrees to cancel a goal and then goes on with it."""
    for goal in recording.goals:
        agreed = goal.at("canceling")
        if agreed is not None and goal.status != "canceled" and _went_on(goal, agreed, recording):
            went_on = f"carried on until it {_past(goal)}" if goal.over else "carried on anyway"
            return (
                f"{goal.server} agreed at {agreed:.3g} s to cancel the goal of {goal.action}, but {went_on}. "
                "Check goal_handle.is_cancel_requested in the loop: when it is True, call "
                "goal_handle.canceled() and return the result."
            )
    return ""


def cancel_not_handled(recording: Recording) -> str:
    """A server that is too busy with a goal to notice its cancel request."""
    for goal in recording.goals:
        asked, noticed = goal.at(CANCEL_REQUESTED), goal.at("canceling") or goal.at(CANCEL_REJECTED)
        if asked is None or goal.at("executing") is None or (noticed is not None and noticed <= asked):
            continue
        if noticed is None and recording.ended.stamp - asked < _LAST_MOMENT:
            continue
        if not goal.over or (noticed is not None and _ended_at(goal, recording) <= noticed):
            held = _cancel_callback(recording, goal, asked)
            if held > 0.0:
                return (
                    f"{goal.client} requested at {asked:.3g} s that its goal be canceled, but the cancel "
                    f"callback of {goal.server} took {held:.3g} s; meanwhile the goal carried on and ended. "
                    "Return CancelResponse.ACCEPT at once, and do anything that takes time in execute, once "
                    "goal_handle.is_cancel_requested is True."
                )
            late = f"received it only at {noticed:.3g} s" if noticed is not None else "never received it"
            return (
                f"{goal.client} requested at {asked:.3g} s that its goal be canceled, but {goal.server} "
                f"{late}: the execute callback kept the node busy. Spin the node with a "
                "MultiThreadedExecutor, or let execute await a pause instead of calling time.sleep."
            )
    return ""


def cancel_refused(recording: Recording) -> str:
    """A server that refuses to cancel a goal that it still executes."""
    for goal in recording.goals:
        refused = goal.at(CANCEL_REJECTED)
        ended = goal.at(goal.status) if goal.over else None
        if refused is not None and goal.at("canceling") is None and (ended is None or refused < ended):
            return (
                f"{goal.server} refused at {refused:.3g} s to cancel the goal of {goal.action}. Without a "
                "cancel_callback an ActionServer always refuses: give it one that returns "
                "CancelResponse.ACCEPT."
            )
    return ""


def _ended_at(goal: Goal, recording: Recording) -> float:
    """When a goal ended; the end of the run for one that did not."""
    stamp = goal.at(goal.status) if goal.over else None
    return recording.ended.stamp if stamp is None else stamp


def _went_on(goal: Goal, agreed: float, recording: Recording) -> bool:
    """Return whether a server had time to see that its goal is to be canceled: it looks once in each step."""
    steps = [after.stamp - before.stamp for before, after in itertools.pairwise(goal.feedback)]
    return _ended_at(goal, recording) - agreed > max([_ONE_STEP, *steps]) + 1e-6


def _cancel_callback(recording: Recording, goal: Goal, requested: float) -> float:
    """For how long a server's cancel callback held the request that came at that time, s."""
    return max(
        (
            run.duration
            for run in recording.callbacks
            if run.node == goal.server and run.kind == "action" and run.stamp == requested
        ),
        default=0.0,
    )


def _past(goal: Goal) -> str:
    how = "was aborted" if goal.status == "aborted" else goal.status
    return f"{how} at {goal.at(goal.status):.3g} s"


def _warned(recording: Recording, words: str) -> bool:
    return any(line.level == "WARN" and words in line.text for line in recording.logs)
