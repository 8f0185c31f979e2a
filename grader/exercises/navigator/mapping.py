"""Exercise on maps: cells and metres, and walls that are made thicker by the robot's size."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from grader.checks import Missed, check, publishes, subscribes
from grader.exercise import Exercise
from grader.exercises.advice import advising
from grader.exercises.navigator.ground import Point
from grader.exercises.navigator.partners import MapServer, PointClicker, made_for
from grader.exercises.navigator.progress import tenths
from grader.exercises.navigator.worlds import world_of
from sim.recording import Recording

GRID, POINT = "nav_msgs/msg/OccupancyGrid", "geometry_msgs/msg/PointStamped"
COSTMAP = "/global_costmap/costmap"
RADIUS = 0.2  # metres by which walls are to be thicker


@check(points=1)
def hears_the_map(recording: Recording) -> None:
    """The node hears /map, though it was published before."""
    with advising(recording, "Subscribe to OccupancyGrid messages on /map, with the profile LATCHED."):
        for end in subscribes(recording, "/map", GRID):
            if end.qos["durability"] != "transient_local":
                raise Missed(
                    "a subscription to /map with the durability transient_local",
                    f"one with {end.qos['durability']}",
                    "The map was published before the node was there. It comes later only to those who "
                    "subscribe with the profile LATCHED in place of a queue depth.",
                )


@check(points=2, after=hears_the_map)
def publishes_a_costmap(recording: Recording) -> None:
    """The node publishes an OccupancyGrid on /global_costmap/costmap, with the form of /map."""
    with advising(recording, "Publish it in on_map, as soon as the map is there."):
        publishes(recording, COSTMAP, GRID)
    given, made = _map(recording), recording.messages(COSTMAP)[-1].message
    forms = [_form(given), _form(made)]
    if forms[0] != forms[1]:
        raise Missed(forms[0], forms[1], "Send the map's own header and info along: only the data changes.")


@check(points=5, after=hears_the_map)
def answers_clicks(recording: Recording) -> None:
    """Each /clicked_point is answered on /cell_centre with the middle of its cell."""
    with advising(recording, "Work one out by hand: the cell is (x - origin) / resolution, rounded down."):
        publishes(recording, "/cell_centre", POINT)
        info, wrong = _map(recording).info, []
        clicks = recording.messages("/clicked_point")
        for click in clicks:
            asked = click.message.point.x, click.message.point.y
            told = _answer(recording, click.stamp)
            if told is None or math.dist(told, _middle(info, asked)) > 0.001:
                wrong.append((click.stamp, asked, told))
        if wrong:
            raise _wrong_cells(info, wrong, len(clicks))


def _wrong_cells(info: Any, wrong: list[tuple[float, Point, Point | None]], asked: int) -> Missed:
    stamp, click, told = wrong[0]
    x, y = _middle(info, click)
    saw = "no answer" if told is None else f"({told[0]:.3f}, {told[1]:.3f})"
    if len(wrong) > 1:
        saw += f"; {len(wrong)} of {asked} are wrong"
    expected = f"({x:.3f}, {y:.3f}) m after the click on ({click[0]:.3f}, {click[1]:.3f}) m at {stamp:.3g} s"
    answered = [(point, answer) for _, point, answer in wrong if answer is not None]
    fitting = (
        hint
        for hint, slip in _SLIPS.items()
        if answered and all(math.dist(answer, slip(info, point)) < 0.001 for point, answer in answered)
    )
    return Missed(expected, saw, next(fitting, ""), credit=tenths(min(1 - len(wrong) / asked, 0.5)))


def _middle(info: Any, point: Point) -> Point:
    return _centre(info, point, math.floor)


def _centre(info: Any, point: Point, whole: Callable[[float], float], offset: float = 0.5) -> Point:
    corner = info.origin.position
    return tuple(
        low + (whole((value - low) / info.resolution) + offset) * info.resolution
        for value, low in zip(point, (corner.x, corner.y), strict=True)
    )


def _without_origin(info: Any, point: Point) -> Point:
    return tuple((math.floor(value / info.resolution) + 0.5) * info.resolution for value in point)


def _origin_half_way(info: Any, point: Point) -> Point:
    corner = info.origin.position
    x, y = _centre(info, point, math.floor)
    return x - corner.x, y - corner.y


_SLIPS: dict[str, Callable[[Any, Point], Point]] = {
    "The map begins at info.origin, not at (0, 0): take the origin away before you divide.": _without_origin,
    "Add the map's origin again in to_point.": _origin_half_way,
    "This is the cell's corner. Its middle is half a cell farther: (column + 0.5) * resolution.": (
        lambda info, point: _centre(info, point, math.floor, 0.0)
    ),
    "round() takes the nearest cell, which may be the next one: use math.floor().": (
        lambda info, point: _centre(info, point, round)
    ),
    "A column and a row are whole numbers: math.floor() rounds down.": (
        lambda info, point: _centre(info, point, lambda value: value)
    ),
    "x belongs to the column and y to the row; here they are swapped.": (
        lambda info, point: _middle(info, point)[::-1]
    ),
}


@check(points=8, after=publishes_a_costmap)
def inflates(recording: Recording) -> None:
    """In the costmap every cell within 0.2 m of an occupied one is 100, and no other cell has changed."""
    given, made = (_cells(msg) for msg in (_map(recording), recording.messages(COSTMAP)[-1].message))
    far = _distance_to_occupied(given) * _map(recording).info.resolution
    known, half = given != -1, 0.5 * _map(recording).info.resolution
    due = known & (given != 100) & (far <= RADIUS + 1e-6)
    sure = due & (far <= RADIUS - half)
    missing, lost = sure & (made != 100), known & (given == 100) & (made != 100)
    extra = known & (far > RADIUS + half) & (made != given)
    faults = int(missing.sum() + lost.sum() + extra.sum())
    if not faults:
        return
    saw = ", ".join(
        f"{int(cells.sum())} {words}"
        for cells, words in ((missing, "missing"), (extra, "too many"), (lost, "no longer occupied"))
        if cells.any()
    )
    credit = tenths(0.8 * (1 - faults / sure.sum()))
    with advising(recording, _inflation_hint(given, made, missing, extra, far)):
        raise Missed(f"{int(due.sum())} cells more that are 100", saw, credit=credit)


def _inflation_hint(
    given: np.ndarray, made: np.ndarray, missing: np.ndarray, extra: np.ndarray, far: np.ndarray
) -> str:
    if np.array_equal(given, made):
        return (
            "The costmap is the map as it was: set cells of the copy, `inflated`, to 100, up to `reach` "
            f"cells away, which is {RADIUS} m / resolution."
        )
    if ((made != given) & (made != 100)).any():
        return "Some cells became another number than 100: that is what stands for occupied."
    if not missing.any() and far[extra].max(initial=0.0) <= RADIUS * 1.5:
        return "Corners are too thick: skip cells that are farther than `reach`, by math.hypot(right, up)."
    if not missing.any() and (made[given != -1] == 100).mean() > 0.9:
        return "Nearly all is occupied: look for occupied cells in the old map, and write into the copy."
    if extra.any() and not missing.any():
        return f"That is too far: it should reach {RADIUS} m, in cells {RADIUS} / resolution."
    if missing.any() and not extra.any():
        return f"It should reach {RADIUS} m in all directions; in cells that is {RADIUS} / resolution."
    return "Is it cells[row, column]: first the row (y), then the column (x)?"


def _map(recording: Recording) -> Any:
    return recording.messages("/map")[0].message


def _answer(recording: Recording, stamp: float) -> Point | None:
    """The first point told after a click, before the next click comes."""
    for heard in recording.messages("/cell_centre"):
        if stamp - 1e-6 <= heard.stamp < stamp + 0.45:
            return heard.message.point.x, heard.message.point.y
    return None


def _cells(msg: Any) -> np.ndarray:
    return np.array(msg.data, dtype=np.int16).reshape(msg.info.height, msg.info.width)


def _distance_to_occupied(cells: np.ndarray) -> np.ndarray:
    """How far each cell's middle is from that of the nearest occupied cell, in cells."""
    rows, columns = np.indices(cells.shape)
    nearest = np.full(cells.shape, np.inf)
    for row, column in np.argwhere(cells == 100):
        nearest = np.minimum(nearest, (rows - row) ** 2 + (columns - column) ** 2)
    return np.sqrt(nearest)


def _form(msg: Any) -> str:
    corner = msg.info.origin.position
    return (
        f"{msg.info.width} by {msg.info.height} cells of {msg.info.resolution:.3g} m from "
        f"({corner.x:.2f}, {corner.y:.2f}) m in the frame “{msg.header.frame_id}”"
    )


costmap = Exercise(
    "costmap",
    "Cells and walls",
    [hears_the_map, publishes_a_costmap, answers_clicks, inflates],
    world=lambda seed: world_of("clutter", seed),
    seconds=8,
    companions=lambda seed: [
        made_for(MapServer, world=world_of("clutter", seed)),
        made_for(PointClicker, world=world_of("clutter", seed)),
    ],
    seeds=(4, 9),
)
