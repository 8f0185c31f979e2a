"""The floor of a world as a grid: what is solid, how far the goal is, and a path that can be driven."""

import functools
import math
from collections.abc import Sequence

import numpy as np

from grader.geometry.pose import Point
from sim.world import World
from sim.world.clearance import clearance

Cell = tuple[int, int]  # (column, row)

RESOLUTION = 0.05  # meters; a cell's width
# Meters of unknown cells around the world's bounds. It is no whole number of cells, and less than walls are
# inflated by: so a program that does not check where the map ends fails.
MARGIN = 0.12
# Straight and diagonal steps, and those of a chess knight: with them a path is at most 3 % too long.
_STEPS = [(dx, dy) for dx in range(-2, 3) for dy in range(-2, 3) if (dx or dy) and math.gcd(dx, dy) == 1]
TO_NEIGHBORS = [(dx, dy) for dx, dy in _STEPS if max(abs(dx), abs(dy)) == 1]


class Ground:
    """The cells of a world; arrays have the shape (rows, columns), row 0 has the lowest y.

    origin: the map's lower left corner (m). clearance: how far each cell's middle is from everything solid
    (m), 0 inside of it. known: whether the cell is within the world's bounds.
    """

    def __init__(self, world: World) -> None:
        left, bottom, right, top = world.bounds
        self.origin = left - MARGIN, bottom - MARGIN
        self.columns = math.ceil((right - left + 2 * MARGIN) / RESOLUTION)
        self.rows = math.ceil((top - bottom + 2 * MARGIN) / RESOLUTION)
        x = self.origin[0] + (np.arange(self.columns) + 0.5) * RESOLUTION
        y = self.origin[1] + (np.arange(self.rows) + 0.5) * RESOLUTION
        self.x, self.y = np.meshgrid(x, y)
        self.clearance = clearance(world, self.x, self.y)
        near = RESOLUTION * 0.75
        self.known = (self.x > left - near) & (self.x < right + near)
        self.known &= (self.y > bottom - near) & (self.y < top + near)
        self._goal = world.goal

    @property
    def occupied(self) -> np.ndarray:
        """The cells that something solid reaches into."""
        occupied: np.ndarray = self.known & (self.clearance < RESOLUTION * math.sqrt(0.5))
        return occupied

    def cell(self, point: Point) -> Cell:
        """Return the cell that holds a point; for a point outside the map, the nearest one."""
        column, row = (math.floor((value - low) / RESOLUTION)
                       for value, low in zip(point, self.origin, strict=True))
        return min(max(column, 0), self.columns - 1), min(max(row, 0), self.rows - 1)

    def middle(self, cell: Cell) -> Point:
        """Return the middle of a cell (m)."""
        return float(self.x[cell[1], cell[0]]), float(self.y[cell[1], cell[0]])

    def free(self, radius: float) -> np.ndarray:
        """Return the cells in whose middle a disc of this radius (m) touches nothing."""
        free: np.ndarray = self.known & (self.clearance > radius)
        return free

    @functools.cache  # noqa: B019  (grounds are few, and stay cached)
    def to_goal(self) -> np.ndarray:
        """Return the robot's distance from each cell to the world's goal (m); inf where there is no path."""
        return self.lengths(self.free(0.1), _existing(self._goal))

    def lengths(
        self, free: np.ndarray, goal: Point, allowed: Sequence[tuple[int, int]] = _STEPS
    ) -> np.ndarray:
        """Return the distance from each cell to the goal over free cells (m); inf where there is no path.

        allowed: the steps of such a path, in columns and rows.
        """
        width = self.columns + 4  # with two closed cells around, so that no step leaves the array
        open_ = np.zeros((self.rows + 4, width), bool)
        open_[2:-2, 2:-2] = free
        lengths = np.full(open_.shape, np.inf)
        column, row = self.cell(goal)
        flat, flat_open = lengths.ravel(), open_.ravel()
        reached = np.array([(row + 2) * width + column + 2])
        flat[reached] = 0.0
        steps = np.array([[dy * width + dx] for dx, dy in allowed])
        costs = np.array([[math.hypot(dx, dy) * RESOLUTION] for dx, dy in allowed])
        while reached.size:
            # No step is shorter than a cell: cells this near to the nearest one have no shorter path.
            near = flat[reached] < flat[reached].min() + RESOLUTION
            there, length = reached[near] + steps, flat[reached[near]] + costs
            shorter = flat_open[there] & (length < flat[there])
            there, length = there[shorter], length[shorter]
            np.minimum.at(flat, there, length)
            reached = np.unique(np.concatenate((reached[~near], there)))
        return lengths[2:-2, 2:-2].copy()


def _existing(goal: Point | None) -> Point:
    if goal is None:
        raise ValueError("this world has no goal")
    return goal


@functools.lru_cache(maxsize=64)
def ground(world: World) -> Ground:
    """Return the ground of a world; computed once."""
    return Ground(world)


@functools.lru_cache(maxsize=64)
def shortest(world: World, radius: float = 0.12) -> float:
    """Return the length of the shortest path from start to goal for a disc (m); inf without one."""
    floor = ground(world)
    column, row = floor.cell(world.start[:2])
    return float(floor.lengths(floor.free(radius), _existing(world.goal))[row, column])


@functools.lru_cache(maxsize=64)
def drivable(world: World, radius: float = 0.25) -> tuple[Point, ...]:
    """Return a smooth path from start to goal, a point every few centimeters, `radius` (m) from everything.

    Where there is none it comes closer. Raises ValueError when the robot does not fit through.
    """
    floor = ground(world)
    for gap in (radius, 0.2, 0.15, 0.12):
        lengths = floor.lengths(floor.free(gap), _existing(world.goal))
        here = floor.cell(world.start[:2])
        if np.isfinite(lengths[here[1], here[0]]):
            break
    else:
        raise ValueError(f"world {world.name}: there is no way from start to goal")
    path = [world.start[:2]]
    while lengths[here[1], here[0]] > 0:

        def cost(cell: Cell, at: Cell = here) -> float:
            return float(lengths[cell[1], cell[0]] + math.dist(cell, at) * RESOLUTION)

        here = min(((here[0] + dx, here[1] + dy) for dx, dy in _STEPS), key=cost)
        path.append(floor.middle(here))
    smooth = np.array([*path, world.goal])
    for _ in range(3):
        smooth[1:-1] = (smooth[:-2] + smooth[1:-1] + smooth[2:]) / 3
    return tuple((float(x), float(y)) for x, y in smooth)
