"""A client that gives up in time."""

from grader.checks import Missed, hinting, sends_goals
from grader.companions.action_servers import CarpetServer, DriveServer
from grader.exercise import Exercise, Scenario
from grader.geometry.near import is_near
from grader.responses import same
from grader.responses.course_goals import DRIVE, lines, quoted
from grader.variants import Variants
from sim.evidence import CANCEL_REQUESTED, Goal, Recording, Seconds

courier = Exercise("courier", "A client that gives up in time", scenarios=[
    Scenario("yard", seconds=16, seed=1, companions=[DriveServer], name="floor"),
    Scenario("yard", seconds=16, seed=2, companions=[CarpetServer], name="carpet"),
], may_end=True, variants=Variants(
    {"patience": (8, 9, 10)},
    {"meters": (2.0, 1.6, 1.8), "speed": (0.4, 0.4, 0.3), "takes": (5, 4, 6)},
    texts=("{meters:g} m at {speed:g} m/s", "takes {takes} s", "about {meters:g} m", "(speed={speed})",
           "target.x = {meters}", "after {patience} s", "{patience} s after", "create_timer({patience}.0, "),
))


@courier.check(3)
def sends_a_goal_to_drive(run: Recording) -> Goal:
    """The node sends a goal to /drive_on_heading: 2 m at 0.4 m/s."""
    with hinting("self.client.send_goal_async(goal), with goal.target.x and goal.speed set."):
        goal = sends_goals(run, DRIVE, "nav2_msgs/action/DriveOnHeading")[0]
    target, speed = goal.request.target.x, goal.request.speed
    wanted = courier.drawn
    if not (same(target, wanted.meters, 0.01) and same(speed, wanted.speed, 0.01)):
        saw = f"target.x={target:g}, speed={speed:g}"
        expected = f"target.x={wanted.meters} and speed={wanted.speed} in the goal"
        hint = f"goal.target.x = {wanted.meters}; goal.speed = {wanted.speed}."
        raise Missed(expected, saw, hint)
    return goal


@courier.check(4, after=sends_a_goal_to_drive, only="carpet")
def gives_up(run: Recording, goal: Goal) -> None:
    """If the robot isn't there 8 s after the goal was accepted, the node cancels the goal."""
    patience = courier.drawn.patience
    due, cancels = (goal.at("accepted") or 0.0) + patience, _cancel_requests(goal)
    expected = f"a cancel request at {due:.3g} s, {patience} s after the goal was accepted"
    if not cancels:
        hint = (f"self.timer = self.create_timer({patience}.0, self.give_up) in on_response; there "
                "cancel_goal_async().")
        raise Missed(expected, "none", hint)
    if not is_near(cancels[0], due, 0.6):
        hint = (f"The {patience} s begin in on_response: self.create_timer({patience}.0, self.give_up), with "
                "no parentheses after give_up.")
        raise Missed(expected, f"one at {cancels[0]:.3g} s", hint)


@courier.check(3, after=sends_a_goal_to_drive, only="floor")
def leaves_it_alone(run: Recording, goal: Goal) -> None:
    """If the robot arrives in time, nothing is canceled."""
    cancels = _cancel_requests(goal)
    if goal.status == "succeeded" and cancels:
        expected = f"no cancel: the goal succeeded at {goal.ended:.3g} s"
        hint = "The timer is still running after the goal has ended: call self.timer.cancel() in on_result."
        raise Missed(expected, f"one at {cancels[0]:.3g} s", hint)
    if goal.status != "succeeded" or goal.ended is None:
        patience = courier.drawn.patience
        hint = f"The robot would have arrived in time: the {patience} s begin when the goal is accepted."
        raise Missed("a goal that succeeds", f"it was {goal.status or 'never received'}", hint)
    if run.all_exited_at is not None and run.all_exited_at < goal.ended:
        saw = f"your program had already ended at {run.all_exited_at:.3g} s"
        hint = "Spin until the result has arrived."
        raise Missed(f"a node that is still running when the robot arrives, at {goal.ended:.3g} s", saw, hint)


@courier.check(4, after=sends_a_goal_to_drive)
def logs_how_it_ended(run: Recording, goal: Goal) -> None:
    """The outcome is logged: `arrived` as info, or a warning with the server's error_msg."""
    if goal.ended is None:
        hint = f"Cancel it after {courier.drawn.patience} s."
        raise Missed("a goal that ends", f"still {goal.status} at the end", hint)
    arrived = goal.status == "succeeded"
    since = goal.received or goal.ended
    afterwards = run.during(since)
    kind, text, level = (
        ("an info line", "arrived", "INFO") if arrived else ("a warning", goal.result.error_msg, "WARN")
    )
    if not any(text.lower() in line.lower() for line in lines(afterwards, level)):
        hint = ("In on_result: future.result() has status and result. Compare status with "
                "GoalStatus.STATUS_SUCCEEDED; the text is in result.error_msg.")
        raise Missed(f"{kind} with “{text}” after {since:.3g} s", quoted(lines(afterwards)), hint)
    if not arrived and any("arrived" in text.lower() for text in lines(afterwards)):
        hint = "A result doesn't mean success: check future.result().status."
        raise Missed("no “arrived”, because the robot was stopped on the way", "“arrived”", hint)


def _cancel_requests(goal: Goal) -> list[Seconds]:
    """The stamps at which the client requested to cancel a goal."""
    return [stamp for stamp, event in goal.events if event == CANCEL_REQUESTED]
