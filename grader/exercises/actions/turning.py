"""An exercise with the robot: an action server that turns it by an angle."""

from __future__ import annotations

import math

import numpy as np

from grader.checks import Missed, check, subscribes
from grader.exercise import Exercise
from grader.exercises.actions.evidence import (
    ended,
    hinting,
    longest_pause,
    numbers_in,
    offered,
    picked,
    state,
)
from grader.exercises.actions.partners import Captain
from grader.exercises.advice import advising
from sim.exchanges import CANCEL_REQUESTED, Goal
from sim.recording import Recording, Seconds, stamps

SPIN, SPIN_TYPE = "/spin", "nav2_msgs/action/Spin"
NEAR = 0.2  # radians
SETTLING = 0.8  # seconds after the end of a goal, in which the captain sends nothing
SLOWEST = 0.3  # seconds between two messages of feedback


@check(points=3)
def offers_to_turn(recording: Recording) -> None:
    """The node offers the action /spin of type Spin, and hears /odom."""
    offered(recording, SPIN, SPIN_TYPE, 'ActionServer(self, Spin, "/spin", self.execute, ...).')
    with hinting('self.create_subscription(Odometry, "/odom", self.hear_odometry, 10), in __init__.'):
        subscribes(recording, "/odom", "nav_msgs/msg/Odometry")


@check(points=6, after=offers_to_turn)
def turns_by_the_angle(recording: Recording) -> None:
    """Goals to both sides, also by more than half a turn, succeed: the robot has turned by target_yaw."""
    goals = picked(recording, SPIN, lambda goal: goal.request.target_yaw < 5.0)
    right = 0
    for goal in goals:
        target, end = goal.request.target_yaw, ended(goal)
        turned = _turned(recording, goal, math.inf if end is None else end + SETTLING)
        if goal.status != "succeeded" or abs(turned - target) > NEAR:
            with advising(recording, _turning_hint(recording, goal, turned)):
                raise Missed(
                    f"{_named(goal)} succeeded, the robot turned by {target:.2f} rad, within {NEAR:g}",
                    f"{state(goal)}; turned by {turned:.2f} rad",
                    credit=right / 4,
                    picture="path",
                )
        right += 1
    if right < 3:
        hint = "Each goal has to end, so that the next one can come."
        raise Missed("three goals that succeed", f"{right}", hint)


@check(points=4, after=offers_to_turn)
def tells_how_far_it_is(recording: Recording) -> None:
    """Feedback comes several times a second, and says how far the robot has turned."""
    for goal in picked(recording, SPIN):
        began = goal.at("executing")
        if began is None:
            continue
        end = ended(goal) or recording.ended.stamp
        moments = [began, *stamps(goal.feedback), end]
        if longest_pause(moments) > SLOWEST + 0.2:
            with advising(recording, "In the loop: goal_handle.publish_feedback(feedback), then the pause."):
                saw = f"none for {longest_pause(moments):.2g} s"
                raise Missed(f"feedback on {_named(goal)} at least every {SLOWEST:g} s", saw)
        _tells_the_truth(recording, goal)


def _tells_the_truth(recording: Recording, goal: Goal) -> None:
    way = _way(recording, goal)
    for heard in goal.feedback:
        turned, told = _at(way, heard.stamp), heard.message.angular_distance_traveled
        if not abs(abs(told) - abs(turned)) < NEAR:
            hint = "The field angular_distance_traveled is how far the robot has turned since the goal began."
            expected = f"angular_distance_traveled={turned:.2f} at {heard.stamp:.3g} s, in the feedback"
            with advising(recording, hint):
                raise Missed(f"{expected} on {_named(goal)}", f"{told:.2f}")


@check(points=3, after=offers_to_turn)
def stops_when_canceled(recording: Recording) -> None:
    """A goal that is canceled ends as canceled, and the robot stands still within a second."""
    goal, asked = _canceled(recording)
    end = ended(goal)
    if goal.status != "canceled" or end is None or end - asked > 0.5:
        with advising(
            recording, "In the loop: if goal_handle.is_cancel_requested, stop, canceled() and return."
        ):
            raise Missed(f"{_named(goal)} canceled within 0.5 s of {asked:.3g} s", state(goal))
    moved = _turned(recording, goal, asked + 2.0) - _turned(recording, goal, asked + 0.8)
    if abs(moved) > 0.05:
        raise Missed(
            f"a robot that stands still 0.8 s after it was asked to stop, at {asked:.3g} s",
            f"it turned {abs(moved):.2f} rad further",
            "Canceled isn't stopped: send a Twist() of zeros before you call canceled().",
            picture="path",
        )


@check(points=3, after=stops_when_canceled)
def says_how_far_it_came(recording: Recording) -> None:
    """The result of the canceled goal says in error_msg how far the robot came, in radians."""
    goal, _ = _canceled(recording)
    turned = _turned(recording, goal, ended(goal) or math.inf)
    text = goal.result.error_msg if goal.result is not None else ""
    if not any(abs(abs(number) - abs(turned)) < NEAR for number in numbers_in(text)):
        hint = 'return Spin.Result(error_msg=f"canceled after {self.turned:.2f} rad").'
        raise Missed(f"about {turned:.2f} rad in the error_msg of {_named(goal)}", f"“{text}”", hint)


def _canceled(recording: Recording) -> tuple[Goal, Seconds]:
    goal = picked(recording, SPIN, lambda goal: goal.request.target_yaw > 5.0)[0]
    asked = goal.at(CANCEL_REQUESTED)
    if asked is None:
        raise Missed(f"{_named(goal)} accepted and executed", state(goal))
    return goal, asked


def _named(goal: Goal) -> str:
    return f"the goal (target_yaw={goal.request.target_yaw:.2f}) at {goal.asked or 0.0:.3g} s"


def _turned(recording: Recording, goal: Goal, until: Seconds) -> float:
    """How far the robot really turned, from when the goal was sent; radians, positive to the left."""
    return _at(_way(recording, goal), until)


def _way(recording: Recording, goal: Goal) -> tuple[np.ndarray, np.ndarray]:
    """Stamps since the goal was sent, and how far the robot has turned by then."""
    poses = [pose for pose in recording.path if pose.stamp >= (goal.asked or 0.0)] or recording.path[-1:]
    yaws = np.unwrap([pose.yaw for pose in poses])
    return np.array([pose.stamp for pose in poses]), yaws - yaws[0]


def _at(way: tuple[np.ndarray, np.ndarray], stamp: Seconds) -> float:
    moments, turned = way
    return float(turned[max(0, int(np.searchsorted(moments, stamp, side="right")) - 1)])


def _turning_hint(recording: Recording, goal: Goal, turned: float) -> str:
    target, over = goal.request.target_yaw, abs(turned) - abs(goal.request.target_yaw)
    told = [heard.message.angular_distance_traveled for heard in goal.feedback]
    if told and abs(told[0]) > 0.3:
        return "The angle of the goal before is still there: self.turned = 0.0 at the beginning of execute."
    if told and abs(told[-1]) > 5 * abs(turned) > 0.05:
        return "It stopped far too early: are all angles in radians? The robot's are, and the goal's, too."
    if abs(turned) < 0.05 and goal.status == "succeeded":
        return "The robot hasn't turned: send a Twist with angular.z in the loop, each time."
    if turned * target < 0:
        return "It turned the wrong way: a negative target_yaw is to the right, with a negative angular.z."
    if not goal.over and abs(turned) < 0.05:
        return "The robot stands, and the goal never ends: send a Twist in the loop, each time."
    if not goal.over and told and abs(told[-1]) < 0.01:
        return (
            "It turned on and on, for self.turned stays 0: does hear_odometry add to it? And does execute "
            "await self.pause(...)? While it sleeps, the node is deaf to /odom."
        )
    if not goal.over and told and max(map(abs, told)) < 0.1:
        return "It turned on and on, for self.turned is the last step only. Add up: self.turned += ..."
    if not goal.over:
        return (
            "It turned on and on. From pi the yaw jumps to -pi: add up small steps, each one "
            "math.remainder(yaw - self.yaw, math.tau), to self.turned."
        )
    if over > 0.25:
        return "It turned on after its goal: send a Twist() of zeros when it has arrived, and turn slowly."
    return (
        "self.turned adds up the small steps between messages of /odom, from 0 with each goal. After each "
        "step hear_odometry keeps the yaw: self.yaw = yaw."
    )


turn = Exercise(
    "turn",
    "A robot that turns",
    [offers_to_turn, turns_by_the_angle, tells_how_far_it_is, stops_when_canceled, says_how_far_it_came],
    world="yard",
    seconds=40,
    companions=[Captain],
    seeds=(1, 2),
)
