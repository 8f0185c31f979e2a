"""An action server that turns the robot by an angle."""

import bisect
import math
from collections.abc import Callable

import numpy as np

from grader.checks import Missed, hinting, otherwise, subscribes
from grader.checks.actions import state
from grader.checks.topics import longest_pause
from grader.companions.goal_senders import Captain
from grader.exercise import Exercise, Scenario
from grader.geometry.near import is_near
from grader.responses import same, states
from grader.responses.course_goals import SPIN, offered, picked
from grader.worlds.trusting import trusting
from sim.evidence import CANCEL_REQUESTED, Goal, Recording, Seconds, stamps

NEAR = 0.2  # radians
SETTLING = 0.8  # seconds after the end of a goal, in which the captain sends nothing
SLOWEST = 0.3  # seconds between two messages of feedback

turn = Exercise("turn", "A robot that turns", scenarios=[
    Scenario("yard", 40, 1, [Captain]),
    Scenario(trusting("yard"), 40, 2, [Captain]),
])


@turn.check(3)
def offers_to_turn(run: Recording) -> None:
    """The node offers the action /spin of type Spin, and subscribes to /odom."""
    offered(run, SPIN, "nav2_msgs/action/Spin")
    with hinting('self.create_subscription(Odometry, "/odom", self.on_odometry, 10), in __init__.'):
        subscribes(run, "/odom", "nav_msgs/msg/Odometry")


@turn.check(6, after=offers_to_turn, guess={
    "The angle from the previous goal is still there: set self.turned = 0.0 at the beginning of execute.":
        lambda run, goal, turned: any(not is_near(angle, 0.0, 0.3) for angle in _angles(goal)[:1]),
    "It stopped far too early: are all angles in radians? The robot's and the goal's are.":
        lambda run, goal, turned: not is_near(turned, 0.0, 0.01)
        and any(not is_near(angle, 0.0, 5 * abs(turned)) for angle in _angles(goal)[-1:]),
    "The robot hasn't turned: publish a Twist with angular.z on every pass through the loop.":
        lambda run, goal, turned: abs(turned) < 0.05 and goal.status == "succeeded",
    "It turned the wrong way: a negative target_yaw is a turn to the right, and needs a negative angular.z.":
        lambda run, goal, turned: turned * goal.request.target_yaw < 0,
    "The robot stands still, and the goal never ends: publish a Twist on every pass through the loop.":
        lambda run, goal, turned: not goal.over and abs(turned) < 0.05,
    "It never stopped turning, because self.turned stays 0: does on_odometry add to it? And does "
    "execute await self.pause(...)? While execute sleeps, the node receives no /odom.":
        lambda run, goal, turned: not goal.over and any(abs(a) < 0.01 for a in _angles(goal)[-1:]),
    "It never stopped turning, because self.turned is only the last step. Add the steps up: self.turned += "
    "...":
        lambda run, goal, turned: not goal.over and 0 < max(map(abs, _angles(goal)), default=0) < 0.1,
    "It never stopped turning. At pi the yaw jumps to -pi: add small steps to self.turned, "
    "each one math.remainder(yaw - self.yaw, math.tau).": lambda run, goal, turned: not goal.over,
    "It kept turning past its goal: publish a Twist() of zeros when it has arrived, and turn slowly.":
        lambda run, goal, turned: not is_near(turned, 0.0, abs(goal.request.target_yaw) + 0.25),
    "self.turned is the sum of the small steps between /odom messages, starting from 0 for each goal. "
    "After each step on_odometry stores the yaw: self.yaw = yaw.": otherwise,
})
def turns_by_the_angle(run: Recording) -> None:
    """Goals to either side, even of more than half a turn, succeed: the robot has turned by target_yaw."""
    goals = picked(run, SPIN, lambda goal: goal.request.target_yaw < 5.0)
    for number, goal in enumerate(goals):
        target = goal.request.target_yaw
        turned = _turned(run, goal)(math.inf if goal.ended is None else goal.ended + SETTLING)
        if goal.status != "succeeded" or not is_near(turned, target, NEAR):
            expected = f"{_text(goal)} succeeded, the robot turned by {target:.2f} rad, within {NEAR:g}"
            saw = f"{state(goal)}; turned by {turned:.2f} rad"
            raise Missed(expected, saw, credit=number / 4, picture="path", about=(goal, turned))
    if len(goals) < 3:
        raise Missed("three goals that succeed", f"{len(goals)}")


@turn.check(4, after=offers_to_turn)
def publishes_how_far_it_is(run: Recording) -> None:
    """Feedback comes several times a second, and contains how far the robot has turned."""
    goals = picked(run, SPIN)
    if not any(goal.feedback for goal in goals):
        guess = "In the loop: goal_handle.publish_feedback(feedback), then the pause."
        raise Missed(f"feedback on {_text(goals[0])} at least every {SLOWEST:g} s", "none", guess=guess)
    for goal in goals:
        began = goal.at("executing")
        if began is None:
            continue
        pause, _ = longest_pause([began, *stamps(goal.feedback), goal.ended or run.ended.stamp])
        if pause > SLOWEST + 0.2:
            expected = f"feedback on {_text(goal)} at least every {SLOWEST:g} s"
            guess = "In the loop: goal_handle.publish_feedback(feedback), then the pause."
            raise Missed(expected, f"none for {pause:.2g} s", guess=guess)
        _feedback_is_true(run, goal)


def _feedback_is_true(run: Recording, goal: Goal) -> None:
    turned_by = _turned(run, goal)
    for row in goal.feedback:
        turned, sent = turned_by(row.stamp), row.message.angular_distance_traveled
        if not same(abs(sent), abs(turned), NEAR):
            expected = (f"angular_distance_traveled={turned:.2f} at {row.stamp:.3g} s, in the feedback on "
                        f"{_text(goal)}")
            guess = ("Set angular_distance_traveled to how far the robot has turned since the goal "
                     "began.")
            raise Missed(expected, f"{sent:.2f}", guess=guess)


@turn.check(3, after=offers_to_turn)
def stops_when_canceled(run: Recording) -> Goal:
    """A goal that is canceled ends as canceled, and the robot stands still within a second."""
    goal = picked(run, SPIN, lambda goal: goal.request.target_yaw > 5.0)[0]
    requested = goal.at(CANCEL_REQUESTED)
    if requested is None:
        raise Missed(f"{_text(goal)} accepted and executed", state(goal))
    if goal.status != "canceled" or goal.ended is None or goal.ended - requested > 0.5:
        expected = f"{_text(goal)} canceled within 0.5 s of {requested:.3g} s"
        guess = "In the loop: if goal_handle.is_cancel_requested, stop, canceled() and return."
        after = _turned(run, goal)
        moves = not is_near(after(requested + 2.0), after(requested + 0.8), 0.05)
        raise Missed(expected, state(goal), guess=guess, unsafe=moves)
    turned_by = _turned(run, goal)
    moved = turned_by(requested + 2.0) - turned_by(requested + 0.8)
    if not is_near(moved, 0.0, 0.05):
        expected = f"a robot that stands still 0.8 s after the cancel request at {requested:.3g} s"
        hint = "Canceled isn't stopped: publish a Twist() of zeros before you call canceled()."
        raise Missed(expected, f"it turned {abs(moved):.2f} rad further", hint, picture="path", unsafe=True)
    return goal


@turn.check(3, after=stops_when_canceled)
def returns_how_far_it_came(run: Recording, goal: Goal) -> None:
    """The result of the canceled goal says in error_msg how far the robot came, in radians."""
    turned = _turned(run, goal)(goal.ended or math.inf)
    text = goal.result.error_msg if goal.result is not None else ""
    if not states(text, turned, -turned, tolerance=NEAR):
        hint = 'return Spin.Result(error_msg=f"canceled after {self.turned:.2f} rad").'
        raise Missed(f"about {turned:.2f} rad in the error_msg of {_text(goal)}", f"“{text}”", hint)


def _text(goal: Goal) -> str:
    return f"the goal (target_yaw={goal.request.target_yaw:.2f}) at {goal.requested or 0.0:.3g} s"


def _turned(run: Recording, goal: Goal) -> Callable[[Seconds], float]:
    """Return how far the robot really turned from the goal's request to a moment; radians, + to the left."""
    poses = run.during(goal.requested or 0.0).path or run.path[-1:]
    moments, yaws = [pose.stamp for pose in poses], np.unwrap([pose.yaw for pose in poses])
    return lambda until: float(yaws[max(0, bisect.bisect_right(moments, until) - 1)] - yaws[0])


def _angles(goal: Goal) -> list[float]:
    return [row.message.angular_distance_traveled for row in goal.feedback]
