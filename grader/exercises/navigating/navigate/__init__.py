"""A design exercise, the whole navigator: an action server for every client of Nav2's NavigateToPose."""

import itertools
import math
from collections.abc import Callable
from typing import Any

from grader.checks import Missed, cancels, has_no_contacts, series, serves_action, tenths, traveled
from grader.checks.motion import after_a_touch, goal_in, is_hopeless, length, world_in
from grader.companions.goals import GoalClient
from grader.companions.maps import bringup, made_for
from grader.diagnosis.driving import still_obeyed
from grader.exercise import Exercise, Scenario
from grader.exercises.navigating.navigate.navigation import (
    ACTION,
    TYPE,
    end_of,
    feedback_faults,
    goals_from_course,
    to_go,
)
from grader.responses import Window
from grader.worlds.rooms import blocked, world_of
from sim.evidence import CANCEL_REQUESTED, Goal, Recording, Seconds, stamps
from sim.world import World

NEAR = 0.25  # meters; as Nav2's goal checker
RIGHT, POOR = 1.4, 2.0  # times the shortest way: full points, no points
SLOW = 0.15  # m/s; on the shortest way, so that there is time for turns and detours
FEEDBACK = 2.0  # seconds between two messages at most
THREADS = "spin the node with a MultiThreadedExecutor"
CANCEL_AFTER = 5.0  # seconds
LATE = 1.5  # s after its start the localization first publishes, in one of the runs: after the goal
TURNED = ("This lidar is mounted turned: its rays start from the pose of scan.header.frame_id in the map, at "
          "header.stamp.")


def _done(goals: int) -> Any:
    """Ends a run 1 s after the last of so many goals, or when nothing more will come of it."""

    def until(run: Recording) -> bool:
        if is_hopeless(run, patience=30.0):
            return True
        if not run.goals:
            return run.stamp > 8
        ended, wait = run.goals[-1].ended, 1 if len(run.goals) >= goals else CANCEL_AFTER + 3
        return ended is not None and run.stamp > ended + wait

    return until


def _scenario(kind: str, seed: int, cancel_after: float | None = None, late: Seconds = 0.0) -> Scenario:
    def worlds(seed: int) -> tuple[World, World]:
        return blocked(seed) if kind == "blocked" else (world_of(kind, seed),) * 2

    def companions(seed: int) -> list[Any]:
        real, known = worlds(seed)
        client = made_for(GoalClient, goal=real.goal, cancel_after=cancel_after)
        return [*bringup(real, known, late), client]

    goals = 1 if cancel_after is None else 2
    return Scenario(lambda seed: worlds(seed)[0], 100, seed, companions, _done(goals), name=kind)


navigate = Exercise("navigate", "The navigator, your way", scenarios=[
    _scenario("clutter", 3, CANCEL_AFTER), _scenario("maze", 2, late=LATE),
    _scenario("blocked", 2),
])
KNOWN = "clutter", "maze"  # where every obstacle is in the map


def _other_action(run: Recording) -> Any:
    others = [end.name for end in run.graph.ends("action server") if end.name != ACTION]
    return others and {"other": others[0], "action": ACTION}


@navigate.check(2, hints={
    "Yours is {other}, but clients look for {action}: change the third argument of "
    "ActionServer.": _other_action
}, guess="In __init__: ActionServer(self, NavigateToPose, 'navigate_to_pose', ...).")
def serves(run: Recording) -> None:
    """The node offers the action /navigate_to_pose of type NavigateToPose."""
    serves_action(run, ACTION, TYPE)


def _plans(run: Recording) -> list[Any]:
    return [row.message for row in run.messages("/plan")]


def _succeeded(goal: Goal, left: float) -> bool:
    return goal.status == "succeeded" and left > NEAR


def _stands(run: Recording) -> bool:
    return traveled(run) < 0.05


ARRIVES: dict[str, Callable[..., Any]] = {
    "The goal was rejected. Without a goal_callback every goal is accepted.":
        lambda run, goal, left: goal.status == "rejected",
    "The goal is reported as succeeded before the robot has moved: keep looping until the robot is there.":
        lambda run, goal, left: _succeeded(goal, left) and _stands(run),
    "That is too early: keep looping until the robot is within 0.1 m.":
        lambda run, goal, left: _succeeded(goal, left) and left < 1.0,
    "The goal is reported as succeeded, but the robot isn't there. The goal is in the frame map: compare it "
    "with the robot's pose in the map, not with /odom.": lambda run, goal, left: _succeeded(goal, left),
    "The goal was aborted before there was a plan: wait in the loop until the pose and the map are there.":
        lambda run, goal, left: goal.status == "aborted" and not _plans(run),
    "No plan was published. In the loop, when there is no path yet or it is blocked: self.plan(goal). And "
    f"while a goal is executed the node has to receive /tf and /map: {THREADS}.":
        lambda run, goal, left: not _plans(run),
    "All plans are empty. Is the start the robot's position in the map, and are both cells free?":
        lambda run, goal, left: not any(plan.poses for plan in _plans(run)),
    f"It plans again and again. Does it mark the box, and nothing else? {TURNED}":
        lambda run, goal, left: run.world.lidar.yaw and len(_plans(run)) > 3,
    f"It only turns on the spot. If self.pose stays the same, no thread is free to receive /tf: {THREADS}.":
        lambda run, goal, left: _stands(run) and any(series(run, "/cmd_vel", "angular.z")),
    "There is a plan, but the robot doesn't drive: publish a Twist on every pass through the loop.":
        lambda run, goal, left: _stands(run),
    "{touch}": lambda run, goal, left: run.contacts and {"touch": after_a_touch(run)},
    "The picture shows where it stopped. Compare it with the last message on /plan.":
        lambda run, goal, left: True,
}


@navigate.check(7, after=serves, only=KNOWN, hints=ARRIVES)
def reaches_the_goal(run: Recording) -> None:
    """The robot gets within 25 cm of the goal, and then the goal succeeds."""
    _succeeds(run)


@navigate.check(4, after=serves, only="blocked", hints=ARRIVES)
def goes_round(run: Recording) -> None:
    """The robot also gets to the goal when a box that is on no map blocks its path; it touches nothing."""
    hint = "The box isn't on the map, but the lidar sees it: plan again when the path is blocked."
    if len(run.messages("/plan")) > 1:
        hint = f"It planned again. Is the box inflated, and marked in the right place? {TURNED}"
    has_no_contacts(run, hint, "no contact")
    _succeeds(run)


@navigate.check(3, after=reaches_the_goal, only=KNOWN)
def touches_nothing(run: Recording) -> None:
    """In a fully mapped world the robot touches nothing."""
    hint = "Inflate walls by more than the robot's radius of 0.1 m, and don't look too far ahead."
    has_no_contacts(run, hint)


@navigate.check(3, after=(serves, reaches_the_goal))
def does_not_dawdle(run: Recording) -> None:
    """The path is at most 40 % longer than the shortest one, and the robot covers 15 cm of it per second."""
    goal = goals_from_course(run)[-1]
    begin, end = goal.at("accepted") or 0.0, end_of(run, goal)
    least = max(to_go(world_in(run), run.pose_at(begin)), 0.5)
    way = length(Window(begin, end).rows(run.path))
    if way > RIGHT * least:
        credit = tenths(0.8 * (1 - (way / least - RIGHT) / (POOR - RIGHT)))
        hint = "The picture shows the detour. Does each new plan begin where the robot is now?"
        expected = f"a path of {RIGHT * least:.1f} m or less"
        raise Missed(expected, f"{way:.1f} m", hint, credit=credit, picture="path")
    most = 5.0 + least / SLOW
    if goal.over and end - begin > most:
        hint = "0.2 to 0.5 m/s is a good speed; turn on the spot only where the path is far to the side."
        raise Missed(f"the goal within {most:.0f} s", f"{end - begin:.0f} s", hint, credit=0.5)


@navigate.check(3, after=(serves, reaches_the_goal))
def reports_the_distance_left(run: Recording) -> None:
    """At least every 2 s there is feedback with the robot's pose, the distance left and the time taken."""
    goal = goals_from_course(run)[-1]
    moments = [goal.at("executing") or 0.0, *stamps(goal.feedback), end_of(run, goal)]
    pause = max(after - before for before, after in itertools.pairwise(moments))
    if pause > FEEDBACK:
        hint = "In the loop of the execute callback: goal_handle.publish_feedback(feedback)."
        saw = f"none for {pause:.3g} s" if goal.feedback else "none"
        raise Missed(f"feedback at least every {FEEDBACK:g} s", saw, hint)
    faults = feedback_faults(run, goal)
    if faults:
        raise Missed(*faults[0], credit=tenths(0.9 - 0.3 * len(faults)))


@navigate.check(2, after=serves, only="clutter")
def obeys_a_cancel(run: Recording) -> None:
    """A goal that the client cancels ends as canceled within 1 s, and the robot stops."""
    first, last = goals_from_course(run)[0], goals_from_course(run)[-1]
    requested = first.at(CANCEL_REQUESTED)
    if requested is None:
        saw = f"a goal that is {last.status or 'not answered'}"
        hint = "First the goal has to be accepted and executed for a while."
        raise Missed("a goal in progress that can be canceled", saw, hint)
    ended = _canceled(run, first, requested)
    later = Window(ended + 0.5, ended + 1.5).rows(run.path)
    moved = math.dist(later[0][1:3], later[-1][1:3]) if later else 0.0
    silence = still_obeyed(run, ended + 1.5)
    if moved > 0.02 or silence:
        hint = "Publish zeros before you return the result." if moved > 0.02 else silence
        saw = f"it drove on for {moved:.2f} m" if moved > 0.02 else "no zeros: other robots would drive on"
        raise Missed("the robot standing still after the cancel", saw, hint, unsafe=True)


def _canceled(run: Recording, goal: Goal, requested: Seconds) -> Seconds:
    """Return when the goal was canceled, within 1 s of the client's request."""
    expected = f"the goal canceled within 1 s of the request at {requested:.3g} s"
    if goal.ended is not None and goal.ended < requested:
        hint = "The goal ended before the client changed its mind: end it only when the robot is there."
        raise Missed(expected, f"{goal.status} at {goal.ended:.3g} s already", hint)
    try:
        canceled = cancels(run, ACTION, within=1.0, where=lambda other: other.id == goal.id)[0]
        return end_of(run, canceled)
    except Missed as missed:
        path = Window(requested + 1.5, requested + 2.5).rows(run.path)
        raise Missed(expected, missed.saw, missed.hint, unsafe=length(path) > 0.02) from None


def _succeeds(run: Recording) -> None:
    goal, world, there = goals_from_course(run)[-1], world_in(run), goal_in(run)
    end = run.pose_at(end_of(run, goal))
    left = math.dist(there, (end.x, end.y))
    state = goal.status or "not answered"
    if left > NEAR:
        came = 1 - to_go(world, end) / to_go(world, run.path[0])
        expected = f"the robot within {NEAR} m of ({there[0]:.2f}, {there[1]:.2f}) m"
        saw = f"({end.x:.2f}, {end.y:.2f}) m, {left:.2f} m away; the goal is {state}"
        raise Missed(expected, saw, credit=tenths(0.6 * came), picture="path", about=(goal, left))
    if goal.status != "succeeded":
        moment = "the end" if goal.ended is None else f"{goal.ended:.3g} s"
        saw = f"{state} at {moment}, although the robot is there"
        guess = "Call goal_handle.succeed() when the robot has arrived."
        raise Missed("the goal succeeded", saw, guess=guess, credit=0.6)
    if goal.received is None:
        hint = "End the execute callback with `return NavigateToPose.Result()`."
        raise Missed("a result for the client", "none", hint, credit=0.6)
