"""Exercise on planning: the shortest way over the free cells of a map."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from grader.checks import Missed, check, publishes
from grader.exercise import Exercise, Scenario
from grader.exercises.advice import advising
from grader.exercises.navigator.ground import Point, ground
from grader.exercises.navigator.partners import CostmapServer, GoalSender, Localization, made_for
from grader.exercises.navigator.progress import tenths
from grader.exercises.navigator.worlds import world_of
from sim.recording import Heard, Recording
from sim.world import World

PATH = "nav_msgs/msg/Path"
GAP = 0.15  # metres between two points of a path
RIGHT, POOR = 1.1, 1.5  # times the shortest way: full points, no points


@check(points=3)
def answers_a_goal(recording: Recording) -> None:
    """A goal on /goal_pose is answered within 2 s with a Path on /plan, in the frame map."""
    with advising(recording, "Publish the path on /plan, in the callback of /goal_pose."):
        publishes(recording, "/plan", PATH)
    plan = _plan(recording, 0)
    if plan is None or not plan.poses:
        stamp = recording.messages("/goal_pose")[0].stamp
        saw = "no path" if plan is None else "a path without poses"
        hint = "find_path found no way: does it put cells into the queue, and remember where they came from?"
        with advising(recording, hint):
            raise Missed(f"a path to the goal that was sent at {stamp:.3g} s", saw)
    if plan.header.frame_id != "map":
        raise Missed(
            "the frame “map” in the path's header",
            f"“{plan.header.frame_id}”",
            'Without a frame nobody knows where the points lie: path.header.frame_id = "map".',
        )


@check(points=4, after=answers_a_goal)
def leads_to_the_goal(recording: Recording) -> None:
    """The path leads from the robot to the goal, without gaps of more than 15 cm."""
    points, world = _points(_plan(recording, 0)), recording.world
    ends = {"begins at the robot": (points[0], world.start[:2]), "ends at the goal": (points[-1], world.goal)}
    for words, (point, right) in ends.items():
        if math.dist(point, right) > GAP:
            raise Missed(
                f"a path that {words}, ({right[0]:.2f}, {right[1]:.2f}) m",
                f"({point[0]:.2f}, {point[1]:.2f}) m, which is {math.dist(point, right):.2f} m away",
                _ends_hint(points, world),
            )
    gap, near = max((math.dist(one, two), one) for one, two in itertools.pairwise([*points, points[-1]]))
    if gap > GAP:
        saw = f"{gap:.2f} m after ({near[0]:.2f}, {near[1]:.2f}) m"
        raise Missed(
            f"points {GAP} m apart or less", saw, "Every cell of the way belongs into the path.", credit=0.5
        )


@check(points=4, after=leads_to_the_goal)
def keeps_to_free_cells(recording: Recording) -> None:
    """The path stays on free cells."""
    points = _points(_plan(recording, 0))
    cells = _cells(recording)
    floor = ground(recording.world)
    wrong = [point for point in points if cells[floor.cell(point)[::-1]] != 0]
    if wrong:
        x, y = wrong[0]
        hint = "Only cells below 100 may be entered; and it is cells[row][column], so cells[y][x]."
        saw = f"({x:.2f}, {y:.2f}) m, which is occupied; {len(wrong)} of {len(points)} points are"
        raise Missed("all points on free cells", saw, hint)


@check(points=5, after=keeps_to_free_cells)
def is_short(recording: Recording) -> None:
    """The path is at most 10 % longer than the shortest one."""
    points, shortest = _points(_plan(recording, 0)), _shortest(recording)
    way = math.fsum(math.dist(one, two) for one, two in itertools.pairwise(points))
    if way > RIGHT * shortest:
        hint = (
            "A cell may be found again on a shorter way: then note the new cost, and where it came from. "
            "Diagonal steps are sqrt(2) long."
        )
        credit = tenths(0.8 * (1 - (way / shortest - RIGHT) / (POOR - RIGHT)))
        raise Missed(f"a path of {RIGHT * shortest:.2f} m or less", f"{way:.2f} m", hint, credit=credit)


@check(points=2, after=answers_a_goal)
def admits_that_there_is_no_way(recording: Recording) -> None:
    """A goal inside a wall is answered with a Path without poses."""
    plan = _plan(recording, 1)
    if plan is None or plan.poses:
        saw = "no path" if plan is None else f"a path of {len(plan.poses)} poses"
        with advising(recording, "Once the queue is empty there is no way: return [], and publish that."):
            raise Missed("a path without poses, for the goal inside a wall", saw)


def _plan(recording: Recording, goal: int) -> Any:
    """The last path that was published within 2 s of a goal, or None."""
    stamp = recording.messages("/goal_pose")[goal].stamp
    found: list[Heard] = [
        heard for heard in recording.messages("/plan") if stamp - 1e-6 <= heard.stamp <= stamp + 2
    ]
    return found[-1].message if found else None


def _points(plan: Any) -> list[Point]:
    return [(pose.pose.position.x, pose.pose.position.y) for pose in plan.poses]


def _cells(recording: Recording) -> np.ndarray:
    msg = recording.messages("/global_costmap/costmap")[0].message
    return np.array(msg.data, dtype=np.int16).reshape(msg.info.height, msg.info.width)


def _shortest(recording: Recording) -> float:
    world, floor = recording.world, ground(recording.world)
    column, row = floor.cell(world.start[:2])
    return float(floor.lengths(_cells(recording) == 0, world.goal)[row, column])


def _ends_hint(points: list[Point], world: World) -> str:
    if math.dist(points[0], world.goal) < GAP and math.dist(points[-1], world.start[:2]) < GAP:
        return "The way back from the goal to the start has to be turned round: way[::-1]."
    if math.dist(points[-1], world.goal[::-1]) < GAP:
        return "x and y are swapped: a cell is (column, row)."
    return "The way back begins at the goal and ends at the cell that came from nowhere (None)."


def _scenario(kind: str, seed: int) -> Scenario:
    def companions(seed: int) -> list[Any]:
        world = world_of(kind, seed)
        goals = made_for(GoalSender, goals=[world.goal, (world.bounds[0], world.start[1])])
        return [made_for(CostmapServer, world=world), made_for(Localization, start=world.start), goals]

    return Scenario(lambda seed: world_of(kind, seed), 9, seed, companions)


plan = Exercise(
    "plan",
    "A*",
    [answers_a_goal, leads_to_the_goal, keeps_to_free_cells, is_short, admits_that_there_is_no_way],
    scenarios=[_scenario("room", 3), _scenario("maze", 5)],
)
