"""Exercises on clients: one that hears how it goes, and one that doesn't wait for ever."""

from __future__ import annotations

from grader.checks import Missed, check, sends_goals
from grader.exercise import Exercise, Scenario
from grader.exercises.actions.evidence import (
    FIBONACCI,
    FIBONACCI_TYPE,
    ended,
    hinting,
    holds,
    lines,
    numbers_in,
)
from grader.exercises.actions.servers import BusyFibonacci, CarpetServer, DriveServer, LateFibonacci
from sim.exchanges import CANCEL_REQUESTED, Goal
from sim.recording import Recording

ORDER = 7
SOON = 0.3  # seconds between what a client hears and its log line


@check(points=4)
def asks_for_seven(recording: Recording) -> None:
    """The node sends a goal of order 7 to /fibonacci, once there is a server."""
    with hinting("In ask: self.client.send_goal_async(Fibonacci.Goal(order=7), ...)."):
        goals = sends_goals(recording, FIBONACCI, FIBONACCI_TYPE)
    if not goals[-1].server:
        hint = "A goal to nobody is lost: ask only when self.client.server_is_ready() is True."
        saw = f"sent at {goals[-1].asked:.3g} s, before there was a server"
        raise Missed("a goal that the server takes", saw, hint)
    if goals[-1].request.order != ORDER:
        saw = f"order={goals[-1].request.order}"
        raise Missed(f"order={ORDER} in the goal", saw, "goal = Fibonacci.Goal(order=7).")


@check(points=4, after=asks_for_seven)
def logs_the_progress(recording: Recording) -> None:
    """Each feedback is logged at info level, with its newest number."""
    goal = _taken(recording)
    for heard in goal.feedback:
        newest = heard.message.sequence[-1]
        said = lines(recording, heard.stamp, heard.stamp + SOON, "INFO")
        if not any(newest in numbers_in(text) for text in said):
            hint = (
                "send_goal_async(goal, feedback_callback=self.hear_feedback); there the numbers are in "
                "msg.feedback.sequence, and [-1] is the newest."
            )
            with hinting(hint):
                raise Missed(f"an info line with {newest} at {heard.stamp:.3g} s", _said(said))


@check(points=4, after=asks_for_seven)
def logs_the_result(recording: Recording) -> None:
    """The result is logged at info level: the word `result`, and the whole sequence."""
    goal = _taken(recording)
    end = ended(goal)
    if goal.status == "rejected" or end is None:
        return
    said = lines(recording, end, recording.ended.stamp, "INFO")
    wanted = list(goal.result.sequence)
    if not any("result" in text.lower() and holds(text, wanted) for text in said):
        hint = (
            "In hear_result the numbers are in future.result().result.sequence, and list(...) of them prints "
            "well."
        )
        if goal.received is None:
            hint = (
                "Nobody asked for the result. In ask: future.add_done_callback(self.hear_response); there: "
                "goal_handle.get_result_async().add_done_callback(self.hear_result)."
            )
        with hinting(hint):
            raise Missed(f"an info line with “result” and {wanted} after {end:.3g} s", _said(said))


@check(points=3, after=asks_for_seven)
def notices_a_no(recording: Recording) -> None:
    """A goal that is rejected is logged as a warning with the word `rejected`, and nothing else follows."""
    goal = _taken(recording)
    warnings = lines(recording, goal.asked or 0.0, recording.ended.stamp, "WARN")
    rejected = [text for text in warnings if "rejected" in text.lower()]
    if goal.status == "rejected" and not rejected:
        hint = "In hear_response: if not goal_handle.accepted, self.get_logger().warning(...), and return."
        saw = _said(lines(recording, goal.asked or 0.0, recording.ended.stamp))
        with hinting(hint):
            raise Missed(f"a warning with “rejected” after {goal.asked:.3g} s", saw)
    if goal.status != "rejected" and rejected:
        hint = "Warn only if goal_handle.accepted is False: if not goal_handle.accepted: ..."
        raise Missed("no such warning, for the goal was accepted", f"“{rejected[0]}”", hint)


def _taken(recording: Recording) -> Goal:
    return [goal for goal in recording.goals if goal.server][-1]


def _said(said: list[str]) -> str:
    return ", ".join(f"“{text}”" for text in said[:3]) or "no line"


customer = Exercise(
    "customer",
    "A client that hears how it goes",
    [asks_for_seven, logs_the_progress, logs_the_result, notices_a_no],
    scenarios=[
        Scenario(seconds=10, seed=1, companions=[LateFibonacci]),
        Scenario(seconds=10, seed=2, companions=[BusyFibonacci]),
    ],
)


DRIVE, DRIVE_TYPE = "/drive_on_heading", "nav2_msgs/action/DriveOnHeading"
PATIENCE = 8.0  # seconds
METRES = 2.0


@check(points=3)
def asks_to_drive(recording: Recording) -> None:
    """The node sends a goal to /drive_on_heading: 2 m at 0.4 m/s."""
    with hinting("self.client.send_goal_async(goal), with goal.target.x and goal.speed set."):
        goal = sends_goals(recording, DRIVE, DRIVE_TYPE)[0]
    asked = goal.request
    if abs(asked.target.x - METRES) > 0.01 or abs(asked.speed - 0.4) > 0.01:
        saw = f"target.x={asked.target.x:g}, speed={asked.speed:g}"
        raise Missed("target.x=2.0 and speed=0.4 in the goal", saw, "goal.target.x = 2.0; goal.speed = 0.4.")


@check(points=4, after=asks_to_drive)
def gives_up(recording: Recording) -> None:
    """If the robot isn't there 8 s after the goal was accepted, the node cancels the goal."""
    goal = recording.goals_of(DRIVE)[0]
    began, wishes = goal.at("accepted") or 0.0, [at for at, word in goal.events if word == CANCEL_REQUESTED]
    due = began + PATIENCE
    if ended(goal) is not None and (ended(goal) or 0.0) < due and not wishes:
        return
    expected = f"a wish to cancel at {due:.3g} s, 8 s after the goal was accepted"
    if not wishes:
        hint = (
            "self.timer = self.create_timer(8.0, self.give_up) in hear_response; there cancel_goal_async()."
        )
        with hinting(hint):
            raise Missed(expected, "none", hint)
    if abs(wishes[0] - due) > 0.6:
        hint = "The 8 s begin in hear_response: self.create_timer(8.0, self.give_up), without more brackets."
        raise Missed(expected, f"one at {wishes[0]:.3g} s", hint)


@check(points=3, after=asks_to_drive)
def leaves_it_alone(recording: Recording) -> None:
    """If the robot arrives in time, nothing is canceled."""
    goal = recording.goals_of(DRIVE)[0]
    wishes = [at for at, word in goal.events if word == CANCEL_REQUESTED]
    end = ended(goal)
    if goal.status == "succeeded" and wishes:
        hint = "The timer goes on after the goal has ended: in hear_result call self.timer.cancel()."
        raise Missed(f"no cancel: the goal succeeded at {end:.3g} s", f"one at {wishes[0]:.3g} s", hint)


@check(points=4, after=asks_to_drive)
def says_how_it_ended(recording: Recording) -> None:
    """The end is logged: `arrived` as info, or a warning with the server's error_msg."""
    goal = recording.goals_of(DRIVE)[0]
    end = ended(goal)
    if end is None:
        raise Missed("a goal that ends", f"still {goal.status} at the end", "Cancel it after 8 s.")
    since = goal.received or end
    message = goal.result.error_msg
    words, level = ("arrived", "INFO") if goal.status == "succeeded" else (message, "WARN")
    said = lines(recording, since, recording.ended.stamp, level)
    everything = lines(recording, since, recording.ended.stamp)
    if not any(words.lower() in text.lower() for text in said):
        hint = (
            "In hear_result: future.result() has status and result. Compare status with "
            "GoalStatus.STATUS_SUCCEEDED; the words are in result.error_msg."
        )
        with hinting(hint):
            kind = "an info line" if level == "INFO" else "a warning"
            raise Missed(f"{kind} with “{words}” after {since:.3g} s", _said(everything))
    if goal.status != "succeeded" and any("arrived" in text.lower() for text in everything):
        hint = "A result alone doesn't mean success: look at future.result().status."
        raise Missed("no “arrived”, for the robot was stopped on the way", "“arrived”", hint)


courier = Exercise(
    "courier",
    "A client that gives up in time",
    [asks_to_drive, gives_up, leaves_it_alone, says_how_it_ended],
    scenarios=[
        Scenario("yard", seconds=16, seed=1, companions=[DriveServer]),
        Scenario("yard", seconds=16, seed=2, companions=[CarpetServer]),
    ],
)
