"""Cells and meters of a map, and walls that are made thicker by the robot's size."""

import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from grader.checks import Missed, otherwise, publishes, subscribes, tenths
from grader.companions.maps import MapServer, PointClicker, made_for
from grader.exercise import Exercise
from grader.geometry import Point
from grader.geometry.occupancy import cells_of, distances_to_occupied
from grader.responses import Stimuli, Stimulus
from grader.worlds.rooms import world_of
from sim.evidence import Recording

GRID = "nav_msgs/msg/OccupancyGrid"
COSTMAP = "/global_costmap/costmap"
RADIUS = 0.2  # meters by which walls are to be thicker

costmap = Exercise(
    "costmap", "Cells and walls", world=partial(world_of, "clutter"), seconds=8, seeds=(4, 9),
    companions=lambda seed: [made_for(node, world=world_of("clutter", seed))
                             for node in (MapServer, PointClicker)],
)
clicks = Stimuli("/clicked_point", answered_on="/cell_center", within=0.45)


@costmap.check(1, guess="Subscribe to OccupancyGrid messages on /map, with the QoS profile LATCHED.", hints={
    "The map was published before your node was there. Late subscribers receive it only if they subscribe "
    "with the QoS profile LATCHED instead of a queue depth.": otherwise,
})
def receives_the_map(run: Recording) -> Any:
    """The node receives /map, although it was published earlier."""
    for end in subscribes(run, "/map", GRID):
        if end.qos["durability"] != "transient_local":
            expected = "a subscription to /map with durability transient_local"
            raise Missed(expected, f"one with {end.qos['durability']}", about=(end,))
    return run.messages("/map", "/map_server")[0].message


@costmap.check(2, after=receives_the_map)
def publishes_a_costmap(run: Recording, given: Any) -> tuple[Any, Any]:
    """The node publishes an OccupancyGrid on /global_costmap/costmap, with the form of /map."""
    made = publishes(run, COSTMAP, GRID)[-1].message
    expected, saw = _form(given), _form(made)
    if expected == saw:
        expected, saw = (f"{len(msg.data)} cells in data" for msg in (given, made))
    if expected != saw:
        raise Missed(expected, saw, "Copy the map's header and info: only the data changes.")
    walls = cells_of(given) == 100
    kept = int((cells_of(made)[walls] == 100).sum())
    if kept < 0.9 * walls.sum():
        hint = "Start from a copy of the map's cells: occupied cells stay 100."
        raise Missed(f"the {int(walls.sum())} cells that are 100 in the map", f"{kept} of them are", hint)
    return given, made


def _center(info: Any, point: Point, whole: Callable[[float], float] = math.floor,
            offset: float = 0.5) -> Point:
    corner = info.origin.position
    return tuple(
        low + (whole((value - low) / info.resolution) + offset) * info.resolution
        for value, low in zip(point, (corner.x, corner.y), strict=True)
    )


def _without_origin(info: Any, point: Point) -> Point:
    return tuple((math.floor(value / info.resolution) + 0.5) * info.resolution for value in point)


def _origin_half_way(info: Any, point: Point) -> Point:
    x, y = _center(info, point)
    return x - info.origin.position.x, y - info.origin.position.y


def _all_are(formula: Callable[[Any, Point], Point]) -> Callable[..., bool]:
    """The cause of a miss: all wrong answers are what a wrong formula gives."""

    def explains(run: Recording, info: Any, wrong: list[Stimulus]) -> bool:
        answered = [click for click in wrong if click.responses]
        return bool(answered) and all(_is_answered(click, formula(info, _point(click))) for click in answered)

    return explains


@costmap.check(5, after=receives_the_map, hints={
    "The map begins at info.origin, not at (0, 0): subtract the origin before you divide.":
        _all_are(_without_origin),
    "Add the map's origin back in to_point.": _all_are(_origin_half_way),
    "This is the cell's corner. Its center is half a cell farther: (column + 0.5) * resolution.":
        _all_are(lambda info, point: _center(info, point, offset=0.0)),
    "round() may give the next cell: use math.floor().":
        _all_are(lambda info, point: _center(info, point, round)),
    "A column and a row are whole numbers: math.floor() rounds down.":
        _all_are(lambda info, point: _center(info, point, lambda value: value)),
    "x gives the column and y the row; here they are swapped.":
        _all_are(lambda info, point: _center(info, point)[::-1]),
}, guess="Work one case out by hand: the cell is (x - origin) / resolution, rounded down.")
def answers_clicks(run: Recording, given: Any) -> None:
    """Each /clicked_point is answered on /cell_center with the center of its cell."""
    publishes(run, "/cell_center", "geometry_msgs/msg/PointStamped")
    sent = clicks(run)
    known = min((row.stamp for row in run.received("/map")), default=0.0)  # earlier ones can have no answer
    sent = [click for click in sent if click.stamp >= known] or sent
    wrong = [click for click in sent if not _is_answered(click, _center(given.info, _point(click)))]
    if wrong:
        (x, y), right = _point(wrong[0]), _center(given.info, _point(wrong[0]))
        after = f"after the click on ({x:.3f}, {y:.3f}) m at {wrong[0].stamp:.3g} s"
        saw = "({:.3f}, {:.3f})".format(*_first(wrong[0])) if wrong[0].responses else "no answer"
        saw += f"; {len(wrong)} of {len(sent)} are wrong" if len(wrong) > 1 else ""
        credit = tenths(min(1 - len(wrong) / len(sent), 0.5))
        expected = f"({right[0]:.3f}, {right[1]:.3f}) m {after}"
        raise Missed(expected, saw, credit=credit, about=(given.info, wrong))


def _point(click: Stimulus) -> Point:
    return click.value.point.x, click.value.point.y


def _first(click: Stimulus) -> Point:
    return click.values("point.x")[0], click.values("point.y")[0]


def _is_answered(click: Stimulus, point: Point) -> bool:
    return bool(click.responses) and math.dist(_first(click), point) <= 0.001


class Inflation(NamedTuple):
    """The cells of the map and of the costmap, what differs, and how far the walls are."""

    given: np.ndarray
    made: np.ndarray
    missing: np.ndarray
    extra: np.ndarray
    far: np.ndarray  # m

    @property
    def reaches_too_far(self) -> bool:
        """Return whether nothing is missing, but there is more than should be."""
        return bool(self.extra.any() and not self.missing.any())


@costmap.check(8, after=publishes_a_costmap, guess={
    "The costmap is the unchanged map: in the copy, `inflated`, set cells to 100 up to `reach` cells "
    f"away, which is {RADIUS} m / resolution.": lambda run, it: np.array_equal(it.given, it.made),
    "Some cells became a number other than 100: occupied is exactly 100.":
        lambda run, it: ((it.made != it.given) & (it.made != 100)).any(),
    "Corners are too thick: skip cells that are farther away than `reach`, by math.hypot(right, up).":
        lambda run, it: not it.missing.any() and it.far[it.extra].max(initial=0.0) <= RADIUS * 1.5,
    "Nearly everything is occupied: look for occupied cells in the old map, and write into the copy.":
        lambda run, it: not it.missing.any() and (it.made[it.given != -1] == 100).mean() > 0.9,
    f"That is too far: it should reach {RADIUS} m, which is {RADIUS} / resolution in cells.":
        lambda run, it: it.reaches_too_far,
    f"It should reach {RADIUS} m in all directions; in cells that is {RADIUS} / resolution.":
        lambda run, it: it.missing.any() and not it.extra.any(),
    "Did you write cells[row, column]: first the row (y), then the column (x)?": lambda run, it: True,
})
def inflates(run: Recording, maps: tuple[Any, Any]) -> None:
    """In the costmap every cell within 0.2 m of an occupied one is 100, and no other cell has changed."""
    given, made = map(cells_of, maps)
    resolution = maps[0].info.resolution
    far, half = distances_to_occupied(given) * resolution, 0.5 * resolution
    known, occupied = given != -1, given == 100
    due = known & ~occupied & (far <= RADIUS + 1e-6)
    sure = due & (far <= RADIUS - half)
    missing, lost = sure & (made != 100), known & occupied & (made != 100)
    extra = known & (far > RADIUS + half) & (made != given)
    faults = {"missing": missing, "too many": extra, "no longer occupied": lost}
    counts = {words: int(cells.sum()) for words, cells in faults.items() if cells.any()}
    if counts:
        saw = ", ".join(f"{count} {words}" for words, count in counts.items())
        credit = tenths(0.8 * (1 - sum(counts.values()) / sure.sum()))
        it = Inflation(given, made, missing, extra, far)
        raise Missed(f"{int(due.sum())} more cells that are 100", saw, credit=credit, about=(it,))


def _form(msg: Any) -> str:
    corner = msg.info.origin.position
    return (f"{msg.info.width} by {msg.info.height} cells of {msg.info.resolution:.3g} m from "
            f"({corner.x:.2f}, {corner.y:.2f}) m in the frame “{msg.header.frame_id}”")
