"""Exercise on maps: cells and metres, and walls that are made thicker by the robot's size."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from grader.checks import Missed, hinting, publishes, subscribes, usual_mistake
from grader.checks.check import tenths
from grader.checks.no_data import no_data
from grader.companions.maps import MapServer, PointClicker, made_for
from grader.exercise import Exercise
from grader.geometry.ground import Point
from grader.geometry.occupancy import cells_of
from grader.worlds.rooms import world_of
from sim.evidence import Message, Recording, Seconds

GRID, POINT = "nav_msgs/msg/OccupancyGrid", "geometry_msgs/msg/PointStamped"
COSTMAP = "/global_costmap/costmap"
RADIUS = 0.2  # metres by which walls are to be thicker

Formula = Callable[[Any, Point], Point]  # of the map's info and a clicked point

costmap = Exercise(
    "costmap",
    "Cells and walls",
    world=lambda seed: world_of("clutter", seed),
    seconds=8,
    companions=lambda seed: [
        made_for(MapServer, world=world_of("clutter", seed)),
        made_for(PointClicker, world=world_of("clutter", seed)),
    ],
    seeds=(4, 9),
)


@costmap.check(1)
def hears_the_map(run: Recording) -> Any:
    """The node hears /map, though it was published before."""
    with hinting(guess="Subscribe to OccupancyGrid messages on /map, with the profile LATCHED."):
        for end in subscribes(run, "/map", GRID):
            if end.qos["durability"] != "transient_local":
                raise Missed(
                    "a subscription to /map with the durability transient_local",
                    f"one with {end.qos['durability']}",
                    "The map was published before the node was there. It comes later only to those who "
                    "subscribe with the profile LATCHED instead of a queue depth.",
                )
    return run.messages("/map", "/map_server")[0].message


@costmap.check(2, after=hears_the_map)
def publishes_a_costmap(run: Recording, given: Any) -> tuple[Any, Any]:
    """The node publishes an OccupancyGrid on /global_costmap/costmap, with the form of /map."""
    with hinting(guess="Publish it in on_map, as soon as the map is there."):
        made = publishes(run, COSTMAP, GRID)[-1].message
    expected, saw = _form(given), _form(made)
    if expected == saw:
        expected, saw = (f"{len(msg.data)} cells in data" for msg in (given, made))
    if expected != saw:
        raise Missed(expected, saw, "Send the map's own header and info along: only the data changes.")
    walls = cells_of(given) == 100
    kept = int((cells_of(made)[walls] == 100).sum())
    if kept < 0.9 * walls.sum():
        hint = "Begin with a copy of the map's cells: what is occupied there stays 100."
        raise Missed(f"the {int(walls.sum())} cells that are 100 in the map", f"{kept} of them are", hint)
    return given, made


@costmap.check(
    5, after=hears_the_map, guess="Work one out by hand: the cell is (x - origin) / resolution, rounded down."
)
def answers_clicks(run: Recording, given: Any) -> None:
    """Each /clicked_point is answered on /cell_centre with the middle of its cell."""
    publishes(run, "/cell_centre", POINT)
    clicks = _clicks(run)
    if not clicks:
        raise no_data(run, "messages on /clicked_point", "none", run.graph.publishers("/clicked_point"))
    wrong = [click for click in clicks if not click.fits(given.info, _middle)]
    if wrong:
        stamp, point, told = wrong[0]
        x, y = _middle(given.info, point)
        saw = "no answer" if told is None else f"({told[0]:.3f}, {told[1]:.3f})"
        answered = [click for click in wrong if click.told]

        def explains(typo: Formula) -> bool:
            return bool(answered) and all(click.fits(given.info, typo) for click in answered)

        raise Missed(
            f"({x:.3f}, {y:.3f}) m after the click on ({point[0]:.3f}, {point[1]:.3f}) m at {stamp:.3g} s",
            f"{saw}; {len(wrong)} of {len(clicks)} are wrong" if len(wrong) > 1 else saw,
            usual_mistake(_SLIPS, explains),
            credit=tenths(min(1 - len(wrong) / len(clicks), 0.5)),
        )


class Click(NamedTuple):
    """A click on the map, and the point that the node told after it, if any; in metres."""

    stamp: Seconds
    point: Point
    told: Point | None

    def fits(self, info: Any, formula: Formula) -> bool:
        """Is it what the formula gives?"""
        return self.told is not None and math.dist(self.told, formula(info, self.point)) <= 0.001


def _clicks(run: Recording) -> list[Click]:
    """All clicks of ours, with the first point told before the next one comes."""
    found = []
    for heard in run.messages("/clicked_point"):
        if heard.from_course:
            told = run.during(heard.stamp - 1e-6, heard.stamp + 0.45).messages("/cell_centre")
            found.append(Click(heard.stamp, _point(heard), _point(told[0]) if told else None))
    return found


def _point(heard: Message) -> Point:
    return heard.message.point.x, heard.message.point.y


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


_SLIPS: dict[str, Formula] = {
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


@costmap.check(8, after=publishes_a_costmap)
def inflates(run: Recording, maps: tuple[Any, Any]) -> None:
    """In the costmap every cell within 0.2 m of an occupied one is 100, and no other cell has changed."""
    given, made = map(cells_of, maps)
    resolution = maps[0].info.resolution
    far = _distance_to_occupied(given) * resolution
    known, half = given != -1, 0.5 * resolution
    due = known & (given != 100) & (far <= RADIUS + 1e-6)
    sure = due & (far <= RADIUS - half)
    missing, lost = sure & (made != 100), known & (given == 100) & (made != 100)
    extra = known & (far > RADIUS + half) & (made != given)
    faults = {"missing": missing, "too many": extra, "no longer occupied": lost}
    if not any(cells.any() for cells in faults.values()):
        return
    count = sum(int(cells.sum()) for cells in faults.values())
    raise Missed(
        f"{int(due.sum())} cells more that are 100",
        ", ".join(f"{int(cells.sum())} {words}" for words, cells in faults.items() if cells.any()),
        guess=_inflation_hint(given, made, missing, extra, far),
        credit=tenths(0.8 * (1 - count / sure.sum())),
    )


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


def _distance_to_occupied(cells: np.ndarray) -> np.ndarray:
    """How far each cell's middle is from that of the nearest occupied cell, in cells."""
    rows, columns = (np.arange(count) for count in cells.shape)
    in_row = np.full(cells.shape, np.inf)  # squared; then the nearest of all rows
    for column, occupied in zip(columns, (cells == 100).T, strict=True):
        in_row[occupied] = np.minimum(in_row[occupied], (columns - column) ** 2)
    nearest = np.full(cells.shape, np.inf)
    for row, squared in zip(rows, in_row, strict=True):
        np.minimum(nearest, squared + ((rows - row) ** 2)[:, None], out=nearest)
    return np.sqrt(nearest)


def _form(msg: Any) -> str:
    corner = msg.info.origin.position
    return (
        f"{msg.info.width} by {msg.info.height} cells of {msg.info.resolution:.3g} m from "
        f"({corner.x:.2f}, {corner.y:.2f}) m in the frame “{msg.header.frame_id}”"
    )
