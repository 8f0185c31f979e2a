"""Plan the shortest path over the free cells of a map."""

import itertools
import math
from typing import Any

import numpy as np

from grader.checks import Missed, hinting, otherwise, publishes, tenths
from grader.checks.motion import goal_in, world_in
from grader.companions.goals import GoalSender
from grader.companions.maps import CostmapServer, Localization, made_for
from grader.exercise import Exercise, Scenario
from grader.geometry import Point
from grader.geometry.ground import TO_NEIGHBORS, ground
from grader.geometry.near import is_near
from grader.geometry.occupancy import cells_of
from grader.responses import Window, from_course
from grader.worlds.rooms import world_of
from sim.evidence import Recording, Seconds

WITHIN = 2.0  # s from a goal to its path; the next goal comes later
GAP = 0.15  # meters between two points of a path
RIGHT, POOR = 1.05, 1.5  # times the shortest path: full points, no points


def _scenario(kind: str, seed: int) -> Scenario:
    def companions(seed: int) -> list[Any]:
        world = world_of(kind, seed)
        goals = made_for(GoalSender, goals=[world.goal, (world.bounds[0], world.start[1])])
        return [made_for(CostmapServer, world=world), made_for(Localization, start=world.start), goals]

    return Scenario(lambda seed: world_of(kind, seed), 9, seed, companions)


plan = Exercise("plan", "A*", scenarios=[
    _scenario("room", 3), _scenario("maze", 5), _scenario("screened", 2)])


@plan.check(3)
def answers_a_goal(run: Recording) -> list[Point]:
    """A goal on /goal_pose is answered within 2 s with a Path on /plan, in the frame map."""
    with hinting(guess="Publish the path on /plan, in the callback of /goal_pose."):
        publishes(run, "/plan", "nav_msgs/msg/Path")
    stamp, path = _answer(run, 0)
    if path is None or not path.poses:
        guess = ("find_path found no path: does it put cells into the queue, and record which cell each came "
                 "from?")
        saw = "no path" if path is None else "a path without poses"
        raise Missed(f"a path to the goal that was sent at {stamp:.3g} s", saw, guess=guess)
    if path.header.frame_id != "map":
        hint = 'Without a frame the points could be anywhere: path.header.frame_id = "map".'
        raise Missed("the frame “map” in the path's header", f"“{path.header.frame_id}”", hint)
    return [(pose.pose.position.x, pose.pose.position.y) for pose in path.poses]


@plan.check(4, after=answers_a_goal, hints={
    "The path was traced from the goal back to the start: reverse it, way[::-1].":
        lambda run, points: math.dist(points[0], run.world.goal) < GAP
        and math.dist(points[-1], run.world.start[:2]) < GAP,
    "x and y are swapped: a cell is (column, row).":
        lambda run, points: math.dist(points[-1], run.world.goal[::-1]) < GAP,
    "Trace the path back from the goal to the cell that came from nowhere (None).": otherwise,
})
def leads_to_the_goal(run: Recording, points: list[Point]) -> list[Point]:
    """The path leads from the robot to the goal, without gaps of more than 15 cm."""
    begin, end = world_in(run).start[:2], goal_in(run)
    ends = ("begins at the robot", points[0], begin), ("ends at the goal", points[-1], end)
    for words, point, right in ends:
        if not is_near(point, right, GAP):
            saw = f"({point[0]:.2f}, {point[1]:.2f}) m, which is {math.dist(point, right):.2f} m away"
            raise Missed(f"a path that {words}, ({right[0]:.2f}, {right[1]:.2f}) m", saw, about=(points,))
    gap, near = max(_gaps(points))
    if gap > GAP:
        expected = f"points {GAP} m apart or less"
        saw = f"{gap:.2f} m after ({near[0]:.2f}, {near[1]:.2f}) m"
        hint = "Put every cell on the way into the path."
        raise Missed(expected, saw, hint, credit=0.5 if math.isfinite(gap) else 0.0, measured=points)
    return points


@plan.check(4, after=leads_to_the_goal)
def keeps_to_free_cells(run: Recording, points: list[Point]) -> list[Point]:
    """The path stays on free cells."""
    cells, floor = _costmap(run), ground(run.world)
    wrong = [point for point in points if cells[floor.cell(point)[::-1]] != 0]
    if wrong:
        x, y = wrong[0]
        hint = "Enter only cells below 100; and the order is cells[row][column], so cells[y][x]."
        saw = f"({x:.2f}, {y:.2f}) m, which is occupied; {len(wrong)} of {len(points)} points are"
        raise Missed("all points on free cells", saw, hint)
    return points


@plan.check(5, after=keeps_to_free_cells)
def is_short(run: Recording, points: list[Point]) -> None:
    """The path is at most 5 % longer than the shortest one."""
    floor = ground(world_in(run))
    column, row = floor.cell(world_in(run).start[:2])
    shortest = float(floor.lengths(_costmap(run) == 0, goal_in(run), TO_NEIGHBORS)[row, column])
    way = math.fsum(gap for gap, _ in _gaps(points))
    if way > RIGHT * shortest:
        hint = ("A cell may be reached again by a shorter path: then store the new cost, and the cell "
                "it came from. Diagonal steps are sqrt(2) long, and the estimate is the straight distance.")
        credit = tenths(0.8 * (1 - (way / shortest - RIGHT) / (POOR - RIGHT)))
        raise Missed(f"a path of {RIGHT * shortest:.2f} m or less", f"{way:.2f} m", hint, credit=credit)


@plan.check(2, after=leads_to_the_goal)
def admits_that_there_is_no_way(run: Recording) -> None:
    """A goal inside a wall is answered with a Path without poses."""
    _, path = _answer(run, 1)
    if path is None or path.poses:
        saw = "no path" if path is None else f"a path of {len(path.poses)} poses"
        guess = "Once the queue is empty there is no path: return [], and publish a Path without poses."
        raise Missed("a path without poses, for the goal inside a wall", saw, guess=guess)


def _answer(run: Recording, number: int) -> tuple[Seconds, Any]:
    """Return when a goal was sent, and the last path within its time; None without one."""
    goal = from_course(run, "/goal_pose", at_least=number + 1, what="goals on /goal_pose")[number]
    paths = Window.after(goal.stamp, WITHIN).rows(run.messages("/plan"))
    return goal.stamp, paths[-1].message if paths else None


def _gaps(points: list[Point]) -> list[tuple[float, Point]]:
    """The distance from each point to the next one (m), and the point; inf where one is not a number."""
    gaps = [(math.dist(one, two), one) for one, two in itertools.pairwise([*points, points[-1]])]
    return [(gap if math.isfinite(gap) else math.inf, one) for gap, one in gaps]


def _costmap(run: Recording) -> np.ndarray:
    return cells_of(run.messages("/global_costmap/costmap")[0].message)
