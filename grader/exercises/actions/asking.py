"""Exercises on clients: one that hears how it goes, and one that doesn't wait for ever."""

from __future__ import annotations

from grader.checks import Missed, hinting, sends_goals
from grader.exercise import Exercise, Scenario
from grader.exercises.actions.evidence import FIBONACCI, FIBONACCI_TYPE, lines, numbers_in
from grader.exercises.actions.servers import BusyFibonacci, CarpetServer, DriveServer, LateFibonacci
from sim.evidence import CANCEL_REQUESTED, Goal, Recording, Seconds

SOON = 0.3  # seconds between what a client hears and its log line

customer = Exercise(
    "customer",
    "A client that hears how it goes",
    scenarios=[
        Scenario(seconds=10, seed=1, companions=[LateFibonacci], name="late"),
        Scenario(seconds=10, seed=2, companions=[BusyFibonacci], name="busy"),
    ],
    may_end=True,
)


@customer.check(4)
def asks_for_seven(run: Recording) -> Goal:
    """The node sends a goal of order 7 to /fibonacci, once there is a server."""
    with hinting("In ask: self.client.send_goal_async(Fibonacci.Goal(order=7), ...)."):
        goal = sends_goals(run, FIBONACCI, FIBONACCI_TYPE)[-1]
    if not goal.server:
        hint = "A goal to nobody is lost: ask only when self.client.server_is_ready() is True."
        saw = f"sent at {goal.requested:.3g} s, before there was a server"
        raise Missed("a goal that the server takes", saw, hint)
    if goal.request.order != 7:
        raise Missed("order=7 in the goal", f"order={goal.request.order}", "goal = Fibonacci.Goal(order=7).")
    return goal


@customer.check(4, after=asks_for_seven, only="late")
def logs_the_progress(run: Recording, goal: Goal) -> None:
    """Each feedback is logged at info level, with its newest number."""
    for heard in goal.feedback:
        newest = heard.message.sequence[-1]
        said = lines(run.during(heard.stamp, heard.stamp + SOON), "INFO")
        if not any(newest in numbers_in(text) for text in said):
            hint = (
                "send_goal_async(goal, feedback_callback=self.hear_feedback); there the numbers are in "
                "msg.feedback.sequence, and [-1] is the newest."
            )
            raise Missed(f"an info line with {newest} at {heard.stamp:.3g} s", _told(said), hint)


@customer.check(4, after=asks_for_seven, only="late")
def logs_the_result(run: Recording, goal: Goal) -> None:
    """The result is logged at info level: the word `result`, and the whole sequence."""
    if goal.ended is None:
        return
    said = lines(run.during(goal.ended), "INFO")
    wanted = list(goal.result.sequence)
    if not any("result" in text.lower() and _holds(text, wanted) for text in said):
        hint = (
            "In hear_result the numbers are in future.result().result.sequence, and list(...) of them prints "
            "well."
        )
        if goal.received is None:
            hint = (
                "Nobody asked for the result. In ask: future.add_done_callback(self.hear_response); there: "
                "goal_handle.get_result_async().add_done_callback(self.hear_result)."
            )
        raise Missed(f"an info line with “result” and {wanted} after {goal.ended:.3g} s", _told(said), hint)


@customer.check(3, after=asks_for_seven)
def notices_a_no(run: Recording, goal: Goal) -> None:
    """A goal that is rejected is logged as a warning with the word `rejected`, and nothing else follows."""
    since = run.during(goal.requested)
    rejected = [text for text in lines(since, "WARN") if "rejected" in text.lower()]
    if goal.status == "rejected" and not rejected:
        hint = "In hear_response: if not goal_handle.accepted, self.get_logger().warning(...), and return."
        raise Missed(f"a warning with “rejected” after {goal.requested:.3g} s", _told(lines(since)), hint)
    if goal.status != "rejected" and rejected:
        hint = "Warn only if goal_handle.accepted is False: if not goal_handle.accepted: ..."
        raise Missed("no such warning, for the goal was accepted", f"“{rejected[0]}”", hint)


def _told(said: list[str]) -> str:
    return ", ".join(f"“{text}”" for text in said[:3]) or "no line"


def _holds(text: str, numbers: list[int]) -> bool:
    """Whether a text has these numbers one after the other."""
    found = numbers_in(text)
    return any(found[begin : begin + len(numbers)] == numbers for begin in range(len(found)))


DRIVE = "/drive_on_heading"
PATIENCE = 8.0  # seconds

courier = Exercise(
    "courier",
    "A client that gives up in time",
    scenarios=[
        Scenario("yard", seconds=16, seed=1, companions=[DriveServer], name="floor"),
        Scenario("yard", seconds=16, seed=2, companions=[CarpetServer], name="carpet"),
    ],
    may_end=True,
)


@courier.check(3)
def asks_to_drive(run: Recording) -> Goal:
    """The node sends a goal to /drive_on_heading: 2 m at 0.4 m/s."""
    with hinting("self.client.send_goal_async(goal), with goal.target.x and goal.speed set."):
        goal = sends_goals(run, DRIVE, "nav2_msgs/action/DriveOnHeading")[0]
    asked = goal.request
    if abs(asked.target.x - 2.0) > 0.01 or abs(asked.speed - 0.4) > 0.01:
        saw = f"target.x={asked.target.x:g}, speed={asked.speed:g}"
        raise Missed("target.x=2.0 and speed=0.4 in the goal", saw, "goal.target.x = 2.0; goal.speed = 0.4.")
    return goal


@courier.check(4, after=asks_to_drive, only="carpet")
def gives_up(run: Recording, goal: Goal) -> None:
    """If the robot isn't there 8 s after the goal was accepted, the node cancels the goal."""
    due, wishes = (goal.at("accepted") or 0.0) + PATIENCE, _wishes(goal)
    expected = f"a cancel request at {due:.3g} s, 8 s after the goal was accepted"
    if not wishes:
        hint = (
            "self.timer = self.create_timer(8.0, self.give_up) in hear_response; there cancel_goal_async()."
        )
        raise Missed(expected, "none", hint)
    if abs(wishes[0] - due) > 0.6:
        hint = "The 8 s begin in hear_response: self.create_timer(8.0, self.give_up), without more brackets."
        raise Missed(expected, f"one at {wishes[0]:.3g} s", hint)


@courier.check(3, after=asks_to_drive, only="floor")
def leaves_it_alone(run: Recording, goal: Goal) -> None:
    """If the robot arrives in time, nothing is canceled."""
    wishes = _wishes(goal)
    if goal.status == "succeeded" and wishes:
        expected = f"no cancel: the goal succeeded at {goal.ended:.3g} s"
        hint = "The timer goes on after the goal has ended: in hear_result call self.timer.cancel()."
        raise Missed(expected, f"one at {wishes[0]:.3g} s", hint)
    if goal.status != "succeeded":
        hint = "It would have arrived in time: the 8 s begin when the goal is accepted."
        raise Missed("a goal that succeeds", f"it was {goal.status or 'never taken'}", hint)
    if run.all_exited_at is not None and run.all_exited_at < goal.ended:
        saw, hint = f"your program had ended at {run.all_exited_at:.3g} s", "Spin until the result is there."
        raise Missed(f"a node that is there when the robot arrives, at {goal.ended:.3g} s", saw, hint)


@courier.check(4, after=asks_to_drive)
def says_how_it_ended(run: Recording, goal: Goal) -> None:
    """The end is logged: `arrived` as info, or a warning with the server's error_msg."""
    if goal.ended is None:
        raise Missed("a goal that ends", f"still {goal.status} at the end", "Cancel it after 8 s.")
    arrived = goal.status == "succeeded"
    since = goal.received or goal.ended
    afterwards = run.during(since)
    kind, words, level = (
        ("an info line", "arrived", "INFO") if arrived else ("a warning", goal.result.error_msg, "WARN")
    )
    if not any(words.lower() in text.lower() for text in lines(afterwards, level)):
        hint = (
            "In hear_result: future.result() has status and result. Compare status with "
            "GoalStatus.STATUS_SUCCEEDED; the words are in result.error_msg."
        )
        raise Missed(f"{kind} with “{words}” after {since:.3g} s", _told(lines(afterwards)), hint)
    if not arrived and any("arrived" in text.lower() for text in lines(afterwards)):
        hint = "A result alone doesn't mean success: look at future.result().status."
        raise Missed("no “arrived”, for the robot was stopped on the way", "“arrived”", hint)


def _wishes(goal: Goal) -> list[Seconds]:
    """When its client wanted to cancel a goal."""
    return [at for at, word in goal.events if word == CANCEL_REQUESTED]
