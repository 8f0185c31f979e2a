"""A client of FollowJointTrajectory: send paths, report the feedback, and how each goal ended."""

import itertools
import math
from typing import Any, NamedTuple

from grader.checks import Missed, hinting, otherwise, publishes, sends_goals
from grader.checks.joints import FOLLOW_TRAJECTORY
from grader.checks.services import sent_at
from grader.companions.joint_targets import CRUISE, teacher
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.responses import Window, from_course, last_before, same
from grader.variants import Variants
from grader.worlds.arms import arm_of
from sim.evidence import Goal, Message, Recording, Seconds
from sim.nanoseconds import in_seconds

SOON = 0.5  # s
SENT = 0.2  # of the points, where each path became a goal, but another one
SLOW = 1.5  # times as long as needed, and
REST = 0.5  # s more, is still fine
OVERTAKEN = ("This goal took so long that the next path arrived before it ended: fix the line about the "
             "speed first.")

trajectory = Exercise("trajectory", "A path for the arm", world=arm_of, seconds=14.5, companions=teacher,
                      seeds=(1, 2), waits=False, variants=Variants(
    {"done": ("succeeded", "reached", "done")},
    {"refused": ("rejected", "refused", "declined")},
    texts=("`{done}`", "`{refused}`", "“{done}”", "“{refused}”", '"{done}"', '"{refused}"'),
))


class Lesson(NamedTuple):
    """A path that was requested, and the goal that was sent for it."""

    path: Message
    goal: Goal


class Part(NamedTuple):
    """The way to a point of a goal: how long it takes, how long it should, and with one joint at a time."""

    point: int  # 1 for the first
    begin: Seconds  # since the start of the goal
    end: Seconds
    needed: Seconds
    in_turn: Seconds


@trajectory.check(2)
def sends_a_goal(run: Recording) -> None:
    """The node sends goals to /arm_controller/follow_joint_trajectory."""
    with hinting("Send it in the callback of /path: self.client.send_goal_async(goal, self.on_feedback)."):
        sends_goals(run, *FOLLOW_TRAJECTORY)


@trajectory.check(5, after=sends_a_goal, hints={
    "The path is in radians, and so is the goal: don't convert to degrees.":
        lambda run, path, sent: not all(
            is_near(value, 0.0, 3.2) for point in sent.points for value in point.positions
        ),
    "Make each point of the path a point of the goal, with a new JointTrajectoryPoint for each.":
        lambda run, path, sent: len(sent.points) != len(path.points),
    "The path's joint_names say which number belongs to which joint, and the order differs from "
    "path to path. Copy path.joint_names into the goal along with the positions.":
        lambda run, path, sent: list(path.joint_names) != list(sent.joint_names),
    "Copy the positions unchanged: list(point.positions).": otherwise,
})
def by_their_names(run: Recording) -> list[Lesson]:
    """Each path becomes one goal, with the same points, and each joint under its own name."""
    lessons = _lessons(run)
    for row, goal in lessons:
        path, sent = row.message, goal.request.trajectory
        pairs = itertools.zip_longest(_by_name(path), _by_name(sent))
        for number, (expected, saw) in enumerate(pairs, start=1):
            if expected != saw:
                where = f"at point {number} of the goal at {goal.requested:.3g} s"
                raise Missed(f"{_point_text(expected)} {where}", _point_text(saw), about=(path, sent),
                             credit=SENT, measured=lessons)
    return lessons


@trajectory.check(4, after=by_their_names, hints={
    "time_from_start is not set: Duration(seconds=time).to_msg().":
        lambda run, parts, wrong: not any(part.end for part in parts),
    "time_from_start counts from the start of the whole trajectory, not from the previous point, so "
    "it must grow from point to point: time += ...":
        lambda run, parts, wrong: wrong.begin and same(wrong.end, wrong.needed, 0.02),
    "Each segment takes the same time here. The longer the distance, the more time it needs: distance / 0.8.":
        lambda run, parts, wrong: len({round(part.end - part.begin, 6) for part in parts}) == 1,
    "Both joints turn at the same time: the distance is the larger of the two, max(...), not their sum.":
        lambda run, parts, wrong: same(wrong.end - wrong.begin, wrong.in_turn, 0.02),
    "The distance is that of the joint that has to go farther: max(abs(...)). The first segment begins "
    "where the arm is now, read from /joint_states by name; each later one begins at the previous point.":
        lambda run, parts, wrong: wrong.end - wrong.begin < wrong.needed,
    "The distance (rad) divided by 0.8 rad/s is the time (s); start again from 0 for each goal.": otherwise,
})
def at_the_speed(run: Recording, lessons: list[Lesson]) -> None:
    """From point to point, and from the arm's position to the first, the faster joint turns at 0.8 rad/s."""
    for _, goal in lessons:
        parts = _parts(run, goal)
        for part in parts:
            if not part.needed - 0.01 <= part.end - part.begin <= SLOW * part.needed + REST:
                where = f"on the way to point {part.point} of the goal at {goal.requested:.3g} s"
                saw = f"{part.end - part.begin:.3g} s (time_from_start is {part.end:.3g} s)"
                raise Missed(f"{part.needed:.3g} s or a little more {where}", saw, about=(parts, part))


@trajectory.check(4, after=by_their_names)
def publishes_the_worst_error(run: Recording, lessons: list[Lesson]) -> None:
    """With each feedback, the larger of the two joints' errors is published on /worst_error, unsigned."""
    feedback = [row for _, goal in lessons for row in goal.feedback]
    if not feedback:
        raise Missed("feedback", "none", because=(by_their_names, at_the_speed))
    published = publishes(run, "/worst_error", "std_msgs/msg/Float64")
    for row in feedback:
        window, error = Window.after(row.stamp, SOON), max(map(abs, row.message.error.positions))
        sent = [answer.message.data for answer in window.rows(published)]
        if window.is_over(run) and not any(same(value, error) for value in sent):
            expected = f"{error:.4f} on /worst_error after the feedback at {row.stamp:.3g} s"
            hint = ("Publish max(abs(error) for error in msg.feedback.error.positions): abs of each first, "
                    "then max.")
            raise Missed(expected, f"{sent[0]:.4f}" if sent else "nothing", hint)


@trajectory.check(5, after=by_their_names, hints={
    "The goal response says whether the goal is accepted: if not handle.accepted, there is no result "
    "to wait for, so publish the outcome at once.":
        lambda run, expected, sent: expected == trajectory.drawn.refused,
    "A result doesn't mean success: check whether future.result().status is STATUS_SUCCEEDED or "
    "STATUS_ABORTED; result.error_string says why.": lambda run, expected, sent: (
        expected.startswith("aborted") and sent and sent[0].startswith(trajectory.drawn.done)
    ),
    "get_result_async() returns a future. In its callback check future.result().status, and publish the "
    "word, with the result's error_string if it was aborted.": otherwise,
})
def publishes_outcomes(run: Recording, lessons: list[Lesson]) -> None:
    """Each goal's outcome is on /outcome: “succeeded”, “rejected”, or “aborted: ” and the error_string."""
    published = publishes(run, "/outcome", "std_msgs/msg/String")
    words = {"succeeded": trajectory.drawn.done, "rejected": trajectory.drawn.refused}
    for path, goal in lessons:
        if goal.ended is None or not Window.after(goal.ended, SOON).is_over(run):
            continue
        later = [other.stamp for other, _ in lessons if other is not path and other.stamp >= goal.ended]
        window = Window(path.stamp, goal.ended + SOON).before(min(later, default=math.inf))
        outcome = f"aborted: {goal.result.error_string}" if goal.status == "aborted" else words.get(
            goal.status, goal.status)
        sent = [row.message.data for row in window.rows(published)]
        if sent != [outcome]:
            expected = f"“{outcome}” within {SOON:g} s of {goal.ended:.3g} s, and nothing else for this path"
            saw = ", ".join(f"“{text}”" for text in sent[:4]) or "nothing"
            overtaken = any(path.stamp < other.stamp <= goal.ended for other, _ in lessons)
            raise Missed(expected, saw, OVERTAKEN if overtaken else "", about=(outcome, sent))


def _lessons(run: Recording) -> list[Lesson]:
    """The paths that had time for a goal, each with its goal. Raises Missed unless there is just one."""
    found, goals = [], sends_goals(run, *FOLLOW_TRAJECTORY)
    for path in from_course(run, "/path", at_least=2, settled=SOON, what="two paths"):
        sent = [goal for goal in goals if Window.after(path.stamp, SOON).contains(sent_at(goal))]
        if len(sent) != 1:
            expected = f"one goal within {SOON:g} s of the path at {path.stamp:.3g} s"
            hint = ("Send one goal in the callback of /path, each time it is called. Don't wait there for "
                    "the response: a node that waits in a callback receives nothing, not even the response.")
            raise Missed(expected, f"{len(sent)} of them", hint)
        found.append(Lesson(path, sent[0]))
    return found


def _by_name(path: Any) -> list[dict[str, float]]:
    return [dict(zip(path.joint_names, point.positions, strict=False)) for point in path.points]


def _point_text(point: dict[str, float] | None) -> str:
    if point is None:
        return "no point"
    return ", ".join(f"{name} {value:.3g}" for name, value in sorted(point.items())) or "no joint"


def _parts(run: Recording, goal: Goal) -> list[Part]:
    """The parts of a goal; the first begins where the arm is by the joint states that came last."""
    state = last_before(from_course(run, "/joint_states"), sent_at(goal))
    before = dict(zip(state.message.name, state.message.position, strict=True)) if state else {}
    begin, sent = 0.0, goal.request.trajectory
    found: list[Part] = []
    for point, positions in zip(sent.points, _by_name(sent), strict=True):
        ways = [abs(positions[name] - before.get(name, math.inf)) / CRUISE for name in positions] or [0.0]
        end = in_seconds(point.time_from_start)
        found.append(Part(len(found) + 1, begin, end, max(ways), sum(ways)))
        begin, before = end, positions
    return found
