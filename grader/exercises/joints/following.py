"""An exercise on trajectories: a client of FollowJointTrajectory, with feedback and all endings."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from grader.checks import Missed, hinting, publishes, sends_goals
from grader.checks.no_data import no_data
from grader.exercise import Exercise
from grader.exercises.joints.crew import CRUISE, teacher
from grader.exercises.joints.places import arm_of
from sim.evidence import Goal, Message, Recording
from sim.nanoseconds import in_seconds

ACTION = "/arm_controller/follow_joint_trajectory"
TYPE = "control_msgs/action/FollowJointTrajectory"
SOON = 0.5  # s
SLOW = 1.5  # times as long as needed, and
REST = 0.5  # s more, is still fine
WAITS = (
    "Send one goal in the callback of /path, each time it is called. Don't wait there for the answer: a node "
    "that waits in a callback hears nothing, not even the answer."
)

trajectory = Exercise(
    "trajectory", "A path for the arm", world=arm_of, seconds=14.5, companions=teacher, seeds=(1, 2)
)


class Lesson(NamedTuple):
    """A path that was wanted, and the goal that was sent for it."""

    wish: Message
    goal: Goal


@trajectory.check(2)
def sends_a_goal(run: Recording) -> None:
    """The node sends goals to /arm_controller/follow_joint_trajectory."""
    with hinting("Send it in the callback of /path: self.client.send_goal_async(goal, self.on_feedback)."):
        sends_goals(run, ACTION, TYPE)


@trajectory.check(5, after=sends_a_goal)
def by_their_names(run: Recording) -> list[Lesson]:
    """Each path becomes one goal: the same points, each joint under its own name."""
    lessons = _lessons(run)
    for wish, goal in lessons:
        asked, sent = wish.message, goal.request.trajectory
        wanted, given = _by_name(asked), _by_name(sent)
        if wanted != given:
            index, (one, other) = _first_difference(wanted, given)
            where = f"at point {index} of the goal at {goal.requested:.3g} s"
            raise Missed(f"{one} {where}", other, _why_other(asked, sent))
    return lessons


@trajectory.check(4, after=by_their_names)
def at_the_speed(run: Recording, lessons: list[Lesson]) -> None:
    """From point to point, and from where the arm is to the first, the faster joint turns at 0.8 rad/s."""
    for _, goal in lessons:
        sent, before, since = goal.request.trajectory, _positions_at(run, goal), 0.0
        for number, point in enumerate(sent.points, start=1):
            now = dict(zip(sent.joint_names, point.positions, strict=True))
            time = in_seconds(point.time_from_start)
            needed = max(abs(now[name] - before[name]) for name in now) / CRUISE
            if not needed - 0.01 <= time - since <= SLOW * needed + REST:
                saw = f"{time - since:.3g} s (time_from_start is {time:.3g} s)"
                hint = _why_time(sent.points, needed, time, since)
                where = f"point {number} of the goal at {goal.requested:.3g} s"
                raise Missed(f"{needed:.3g} s or a little more on the way to {where}", saw, hint)
            before, since = now, time


@trajectory.check(4, after=by_their_names)
def tells_how_far_off(run: Recording, lessons: list[Lesson]) -> None:
    """With each feedback, the larger of the two joints' errors goes out on /worst_error, without a sign."""
    if not any(goal.feedback for _, goal in lessons):
        hint = "Without a goal that is accepted there is no feedback: see the other lines first."
        raise Missed("feedback of an arm that follows a path", "none", hint)
    heard = publishes(run, "/worst_error", "std_msgs/msg/Float64")
    for _, goal in lessons:
        for feedback in goal.feedback:
            right = max(abs(error) for error in feedback.message.error.positions)
            near = [one for one in heard if feedback.stamp <= one.stamp < feedback.stamp + SOON]
            if feedback.stamp > run.ended.stamp - SOON or any(_same(one, right) for one in near):
                continue
            raise Missed(
                f"{right:.4f} on /worst_error after the feedback at {feedback.stamp:.3g} s",
                f"{near[0].message.data:.4f}" if near else "nothing",
                "max(abs(error) for error in msg.feedback.error.positions): abs for each of them, then max.",
            )


@trajectory.check(5, after=by_their_names)
def tells_how_it_ended(run: Recording, lessons: list[Lesson]) -> None:
    """Each goal's end goes out on /outcome: “succeeded”, “rejected”, or “aborted: ” and the error_string."""
    said = publishes(run, "/outcome", "std_msgs/msg/String")
    for index, (wish, goal) in enumerate(lessons):
        ended = goal.ended
        if ended is None or ended > run.ended.stamp - SOON:
            continue
        later = [lesson.wish.stamp for lesson in lessons[index + 1 :] if lesson.wish.stamp >= ended]
        until = min(ended + SOON, *later, math.inf)
        right = goal.status
        if right == "aborted":
            right += f": {goal.result.error_string}"
        told = [one.message.data for one in said if wish.stamp <= one.stamp < until]
        if told != [right]:
            raise Missed(
                f"“{right}” within {SOON:g} s of {ended:.3g} s, and nothing else for this path",
                ", ".join(f"“{text}”" for text in told[:4]) or "nothing",
                _why_other_end(right, told),
            )


def _lessons(run: Recording) -> list[Lesson]:
    """All paths with the goals sent for them. Raises Missed for a path without its goal."""
    wishes = [one for one in run.messages("/path") if one.from_course and one.stamp < run.ended.stamp - SOON]
    if len(wishes) < 2:
        raise no_data(run, "two paths", f"{len(wishes)}", run.graph.publishers("/path"))
    found, goals = [], sends_goals(run, ACTION, TYPE)
    for wish in wishes:
        its = [goal for goal in goals if wish.stamp <= goal.requested < wish.stamp + SOON]
        if len(its) != 1:
            with hinting(WAITS):
                saw = f"{len(its)} of them"
                raise Missed(f"one goal within {SOON:g} s of the path at {wish.stamp:.3g} s", saw)
        found.append(Lesson(wish, its[0]))
    return found


def _by_name(path: Any) -> list[dict[str, float]]:
    names = list(path.joint_names)
    return [dict(zip(names, point.positions, strict=False)) for point in path.points]


def _first_difference(wanted: list[dict], given: list[dict]) -> tuple[int, tuple[str, str]]:
    rows = enumerate(itertools.zip_longest(wanted, given), start=1)
    index, pair = next((index, pair) for index, pair in rows if pair[0] != pair[1])
    return index, tuple(_told(point) for point in pair)


def _told(point: dict[str, float] | None) -> str:
    if point is None:
        return "no point"
    return ", ".join(f"{name} {value:.3g}" for name, value in sorted(point.items())) or "no joint"


def _positions_at(run: Recording, goal: Goal) -> dict[str, float]:
    """Where the joints were when the goal was sent, as the arm's driver said last."""
    told = [
        one for one in run.messages("/joint_states") if one.from_course and one.stamp < goal.requested + 1e-6
    ]
    return dict(zip(told[-1].message.name, told[-1].message.position, strict=True))


def _same(heard: Message, value: float) -> bool:
    return abs(heard.message.data - value) < 1e-6


def _why_other(asked: Any, sent: Any) -> str:
    """The usual reasons for other points."""
    if any(abs(value) > 3.2 for point in sent.points for value in point.positions):
        return "The path has radians, and so has the goal: no degrees."
    if len(sent.points) != len(asked.points):
        return "Every point of the path becomes a point of the goal: a new JointTrajectoryPoint for each."
    if list(asked.joint_names) != list(sent.joint_names):
        return (
            "The path says in joint_names which number belongs to which joint, and the order differs from "
            "path to path. Copy path.joint_names into the goal with the positions."
        )
    return "Copy the positions as they are: list(point.positions)."


def _why_time(points: Sequence[Any], needed: float, time: float, since: float) -> str:
    """The usual reasons for other times."""
    times = [in_seconds(point.time_from_start) for point in points]
    if not any(times):
        return "time_from_start is not set: Duration(seconds=time).to_msg()."
    if since and abs(time - needed) < 0.02:
        return (
            "time_from_start counts from the start of the whole trajectory, and not from the point before: "
            "it must rise from point to point. time += ..."
        )
    if len({round(b - a, 6) for a, b in itertools.pairwise([0.0, *times])}) == 1:
        return "Each part takes the same time here. The longer the way, the more time it needs: way / 0.8."
    if time - since < needed:
        return (
            "The way is that of the joint which has to go farther: max(abs(...)). The first one begins where "
            "the arm is now, by /joint_states and by name; and the next one where the point before is."
        )
    return "The way (rad) divided by 0.8 rad/s is the time (s); and it starts anew with each goal."


def _why_other_end(right: str, told: list[str]) -> str:
    """The usual reasons for another word."""
    if right == "rejected":
        return (
            "The first answer says whether the goal is accepted: if not handle.accepted, there is no result "
            "to wait for, and that is the end."
        )
    if right.startswith("aborted") and told and told[0].startswith("succeeded"):
        return (
            "That a result came doesn't mean that it is good: future.result().status is STATUS_SUCCEEDED or "
            "STATUS_ABORTED, and result.error_string says why."
        )
    return (
        "get_result_async() gives a future. In its callback look at future.result().status, and publish the "
        "word; with the result's error_string if it was aborted."
    )
