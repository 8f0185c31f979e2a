"""Exercise: the whole navigator, as an action server that serves every client of Nav2's NavigateToPose."""

from __future__ import annotations

import itertools
import math
from typing import Any

from grader.checks import Missed, cancels, check, series, serves_action, travelled
from grader.exercise import Exercise, Scenario
from grader.exercises.advice import advising
from grader.exercises.navigator.partners import GoalClient, bringup, made_for
from grader.exercises.navigator.progress import (
    ACTION,
    TYPE,
    drive_of,
    end_of,
    is_hopeless,
    last_goal,
    least_way,
    no_estimate,
    pose_at,
    tenths,
    to_go,
    wrong_distance,
    wrong_pose,
)
from grader.exercises.navigator.worlds import blocked, world_of
from sim.exchanges import Goal
from sim.recording import Recording
from sim.world import World

NEAR = 0.25  # metres; as Nav2's goal checker
RIGHT, POOR = 1.35, 2.0  # times the shortest way: full points, no points
SLOW = 0.15  # m/s; on the shortest way, so that there is time for turns and detours
FEEDBACK = 2.0  # seconds between two messages at most
THREADS = "spin the node with a MultiThreadedExecutor"
CANCEL_AFTER = 5.0  # seconds


@check(points=2)
def serves(recording: Recording) -> None:
    """The node serves the action /navigate_to_pose of the type NavigateToPose."""
    others = [end.name for end in recording.graph.ends("action server") if end.name != ACTION]
    try:
        with advising(recording, "In __init__: ActionServer(self, NavigateToPose, 'navigate_to_pose', ...)."):
            serves_action(recording, ACTION, TYPE)
    except Missed as missed:
        if not others:
            raise
        hint = f"Yours is {others[0]}, and clients look for {ACTION}: the third argument of ActionServer."
        raise Missed(missed.expected, missed.saw, hint) from None


@check(points=7, after=serves)
def reaches_the_goal(recording: Recording) -> None:
    """The robot is led to the goal, within 25 cm, and then the goal has succeeded."""
    if recording.world.name != "blocked":
        _succeeds(recording)


@check(points=4, after=serves)
def goes_round(recording: Recording) -> None:
    """The robot gets to the goal, too, when a box that is in no map stands in its way; it touches nothing."""
    if recording.world.name == "blocked":
        if recording.contacts:
            touch = recording.contacts[0]
            hint = "The map doesn't know the box, but the lidar sees it: plan anew when the path is blocked."
            saw = f"a {touch.what} touched at {touch.stamp:.3g} s, at ({touch.x:.2f}, {touch.y:.2f}) m"
            raise Missed("no contact", saw, hint, picture="path")
        _succeeds(recording)


@check(points=3, after=reaches_the_goal)
def touches_nothing(recording: Recording) -> None:
    """In the known world the robot touches nothing."""
    if recording.contacts and recording.world.name != "blocked":
        touch = recording.contacts[0]
        hint = "Inflate walls by more than the robot's radius of 0.1 m, and don't look too far ahead."
        saw = f"a {touch.what} touched at {touch.stamp:.3g} s, at ({touch.x:.2f}, {touch.y:.2f}) m"
        raise Missed("no contact with walls or boxes", saw, hint, picture="path")


@check(points=3, after=reaches_the_goal)
def does_not_dawdle(recording: Recording) -> None:
    """The way is at most 35 % longer than the shortest one, and the robot makes 15 cm of it in a second."""
    goal, least = last_goal(recording), least_way(recording)
    way = travelled(Recording(path=drive_of(recording, goal)))
    if way > RIGHT * least:
        credit = tenths(0.8 * (1 - (way / least - RIGHT) / (POOR - RIGHT)))
        hint = "The picture shows the detour. Does each new plan begin where the robot is now?"
        expected = f"a way of {RIGHT * least:.1f} m or less"
        raise Missed(expected, f"{way:.1f} m", hint, credit=credit, picture="path")
    took = (goal.at(goal.status) or recording.stamp) - (goal.at("accepted") or 0.0)
    if took > 5.0 + least / SLOW:
        hint = "0.2 to 0.5 m/s is a good speed; turn on the spot only where the path is far to the side."
        raise Missed(f"the goal within {5.0 + least / SLOW:.0f} s", f"{took:.0f} s", hint, credit=0.5)


@check(points=3, after=reaches_the_goal)
def tells_how_far(recording: Recording) -> None:
    """At least every 2 s the feedback says where the robot is, how far it is to go and how long it takes."""
    goal = last_goal(recording)
    moments = [goal.at("executing") or 0.0, *(heard.stamp for heard in goal.feedback)]
    pauses = [after - before for before, after in itertools.pairwise([*moments, end_of(recording, goal)])]
    if max(pauses) > FEEDBACK:
        hint = "In the loop of the execute callback: goal_handle.publish_feedback(feedback)."
        saw = f"none for {max(pauses):.3g} s" if goal.feedback else "none"
        raise Missed(f"feedback at least every {FEEDBACK:g} s", saw, hint)
    found = wrong_pose(recording, goal), wrong_distance(recording, goal), no_estimate(goal)
    faults = [fault for fault in found if fault]
    if faults:
        raise Missed(*faults[0], credit=tenths(0.9 - 0.3 * len(faults)))


@check(points=2, after=serves)
def obeys_a_cancel(recording: Recording) -> None:
    """A goal that the client cancels ends as canceled within 1 s, and the robot stops."""
    if recording.world.name != "clutter":
        return
    if not _canceled_one(recording).at("cancel requested"):
        saw = f"a goal that is {last_goal(recording).status or 'not answered'}"
        hint = "First the goal has to be accepted, and be executed for a while."
        raise Missed("a goal under way, to be canceled", saw, hint)
    ended = _canceled(recording)
    later = [pose for pose in recording.path if ended + 0.5 <= pose.stamp <= ended + 1.5]
    moved = math.dist(later[0][1:3], later[-1][1:3]) if later else 0.0
    if moved > 0.02:
        hint = "Send zeros before you return the result."
        raise Missed("the robot standing still after the cancel", f"it drove on for {moved:.2f} m", hint)


def _canceled_one(recording: Recording) -> Goal:
    """The goal that the client cancels: its first."""
    last_goal(recording)
    return recording.goals_of(ACTION)[0]


def _canceled(recording: Recording) -> float:
    """When the goal was canceled."""
    goal = _canceled_one(recording)
    asked = goal.at("cancel requested")
    expected = f"the goal canceled within 1 s of the request at {asked:.3g} s"
    if goal.over and goal.at(goal.status) < asked:
        hint = "The goal was over before the client changed its mind: end it when the robot is there."
        raise Missed(expected, f"{goal.status} at {goal.at(goal.status):.3g} s already", hint)
    try:
        return cancels(recording, ACTION, within=1.0)[0].at("canceled")
    except Missed as missed:
        with advising(recording, "In the loop, look at goal_handle.is_cancel_requested."):
            raise Missed(expected, missed.saw, missed.hint) from None


def _succeeds(recording: Recording) -> None:
    goal, world = last_goal(recording), recording.world
    end = pose_at(recording, end_of(recording, goal))
    left = math.dist(world.goal, (end.x, end.y))
    state = goal.status or "not answered"
    if left > NEAR:
        came = 1 - to_go(world, end) / to_go(world, recording.path[0])
        raise Missed(
            f"the robot within {NEAR} m of ({world.goal[0]:.2f}, {world.goal[1]:.2f}) m",
            f"({end.x:.2f}, {end.y:.2f}) m, {left:.2f} m away; the goal is {state}",
            _driving_hint(recording, goal, left),
            credit=tenths(0.6 * came),
            picture="path",
        )
    if goal.status != "succeeded":
        with advising(recording, "Call goal_handle.succeed() when the robot has arrived."):
            saw = f"{state} at {_end(goal)}, though the robot is there"
            raise Missed("the goal succeeded", saw, credit=0.6)
    if goal.received is None:
        hint = "End the execute callback with `return NavigateToPose.Result()`."
        raise Missed("a result for the client", "none", hint, credit=0.6)


def _end(goal: Goal) -> str:
    return f"{goal.at(goal.status):.3g} s" if goal.over else "the end"


def _driving_hint(recording: Recording, goal: Goal, left: float) -> str:
    """The usual reasons for a robot that doesn't arrive."""
    if goal.status == "rejected":
        return "The goal was rejected. Without a goal_callback every goal is accepted."
    if goal.status == "succeeded":
        return _too_early(recording, left)
    plans = [heard.message for heard in recording.messages("/plan")]
    if not plans:
        return (
            "No plan was published. In the loop: where there is no path yet, or it is blocked, "
            f"self.plan(goal). And while a goal is executed the node has to hear /tf and /map: {THREADS}."
        )
    if not any(plan.poses for plan in plans):
        return "All plans are empty. Is the start where the robot is in the map, and are both cells free?"
    if travelled(recording) < 0.05 and any(series(recording, "/cmd_vel", "angular.z")):
        return f"It only turns on the spot. If self.pose stays the same, nobody hears /tf: {THREADS}."
    if travelled(recording) < 0.05:
        return "There is a plan, but the robot doesn't drive: send a Twist in each turn of the loop."
    if recording.contacts:
        touch = recording.contacts[0]
        return f"It drove into a {touch.what} at {touch.stamp:.3g} s, and its odometry has been wrong since."
    return "The picture shows where it stopped. Compare it with the last message on /plan."


def _too_early(recording: Recording, left: float) -> str:
    if travelled(recording) < 0.05:
        return "It is said to have succeeded before the robot has moved: go on as long as the goal is far."
    if left < 1.0:
        return "That is too early: go on until the robot is nearer than 0.1 m."
    return (
        "It is said to have succeeded, but the robot is not there. The goal is in the frame map: compare it "
        "with the robot's pose in the map, not with /odom."
    )


def _done(goals: int) -> Any:
    """The last of so many goals is over for a second, or nothing more will come of it."""

    def until(recording: Recording) -> bool:
        if is_hopeless(recording, patience=30.0):
            return True
        if not recording.goals:
            return recording.stamp > 8
        last = recording.goals[-1]
        if len(recording.goals) < goals:
            return last.over and recording.stamp > (last.at(last.status) or 0.0) + CANCEL_AFTER + 3
        return last.over and recording.stamp > (last.at(last.status) or 0.0) + 1

    return until


def _scenario(kind: str, seed: int, cancel_after: float | None = None) -> Scenario:
    def worlds(seed: int) -> tuple[World, World]:
        return blocked(seed) if kind == "blocked" else (world_of(kind, seed),) * 2

    def companions(seed: int) -> list[Any]:
        real, known = worlds(seed)
        client = made_for(GoalClient, goal=real.goal, cancel_after=cancel_after)
        return [*bringup(real, known), client]

    goals = 1 if cancel_after is None else 2
    return Scenario(lambda seed: worlds(seed)[0], 100, seed, companions, _done(goals))


navigate = Exercise(
    "navigate",
    "The navigator",
    [serves, reaches_the_goal, goes_round, touches_nothing, does_not_dawdle, tells_how_far, obeys_a_cancel],
    scenarios=[_scenario("clutter", 3, CANCEL_AFTER), _scenario("maze", 2), _scenario("blocked", 2)],
)
