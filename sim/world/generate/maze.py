"""Generates mazes: grid cells with walls between some of the neighbors."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random
from typing import Annotated, Any, NamedTuple

from sim.world.generate.card import card, goal_at
from sim.world.validated_model import Model, within

Cell = tuple[int, int]
"""(column, row), from the lower left."""


class Grid(NamedTuple):
    """A maze: its size, and all pairs of neighbors without a wall in between, left or lower cell first."""

    columns: int
    rows: int
    open: frozenset[tuple[Cell, Cell]]

    def inside(self, cell: Cell) -> bool:
        """Return whether the cell is in the grid."""
        return 0 <= cell[0] < self.columns and 0 <= cell[1] < self.rows

    def passable(self, a: Cell, b: Cell) -> bool:
        """Return whether there is no wall between two neighbors, of which one may be outside the grid."""
        return ((a, b) if a < b else (b, a)) in self.open


@dataclass(frozen=True)
class Maze(Model):
    """A maze with cells of `cell` meters, all of them reachable.

    `loops` is the fraction of inner walls that are removed: with 0 there is exactly one path to each cell.
    """

    columns: Annotated[int, within(2, 40)] = 6
    rows: Annotated[int, within(2, 40)] = 6
    cell: Annotated[float, within(0.4, 5, "meters")] = 1.0
    loops: Annotated[float, within(0, 1)] = 0.0

    def draw(self, rng: Random) -> dict[str, Any]:
        """The fields of a world except its name. Corridors are as wide as cells."""
        maze = generate_maze(self.columns, self.rows, self.loops, rng)
        path = longest_path(maze, (0, 0))
        width, height, cell = self.columns * self.cell, self.rows * self.cell, self.cell
        (x, y), goal = (((column + 0.5) * cell, (row + 0.5) * cell) for column, row in (path[0], path[-1]))
        upwards = path[1][1] > path[0][1]
        lines = merged_walls(maze)
        walls = [((x0 * cell, y0 * cell), (x1 * cell, y1 * cell)) for (x0, y0), (x1, y1) in lines]
        return {
            "bounds": (0.0, 0.0, width, height),
            "start": (x, y, math.pi / 2 if upwards else 0.0),
            "goal": goal,
            "walls": tuple(walls),
            "card": card(
                f"A maze of {self.columns} by {self.rows} cells of {cell:g} m. {goal_at(goal)}, in the cell "
                "that is farthest to drive to.",
                f"In the lower left cell, at x {x:g}, y {y:g}, facing the way out of it.",
            ),
        }


def generate_maze(columns: int, rows: int, loops: float, rng: Random) -> Grid:
    """A maze by depth-first search: all cells are connected, by exactly one path unless `loops` > 0.

    loops: the probability with which each remaining inner wall is removed.
    """
    closed = Grid(columns, rows, frozenset())
    passages: set[tuple[Cell, Cell]] = set()
    seen, trail = {(0, 0)}, [(0, 0)]
    while trail:
        here = trail[-1]
        fresh = [cell for cell in _neighbors(closed, here) if cell not in seen]
        if not fresh:
            trail.pop()
            continue
        there = fresh[math.floor(rng.random() * len(fresh))]
        passages.add((min(here, there), max(here, there)))
        seen.add(there)
        trail.append(there)
    for column in range(columns):
        for row in range(rows):
            here = column, row
            for there in ((column + 1, row), (column, row + 1)):
                if closed.inside(there) and (here, there) not in passages and rng.random() < loops:
                    passages.add((here, there))
    return Grid(columns, rows, frozenset(passages))


def longest_path(maze: Grid, start: Cell) -> list[Cell]:
    """The shortest path from this cell to the cell with the greatest path distance."""
    came_from: dict[Cell, Cell | None] = {start: None}
    queue = [start]
    for here in queue:
        for there in _neighbors(maze, here):
            if there not in came_from and maze.passable(here, there):
                came_from[there] = here
                queue.append(there)
    path = [queue[-1]]
    while (before := came_from[path[-1]]) is not None:
        path.append(before)
    return path[::-1]


def merged_walls(maze: Grid) -> Iterator[tuple[Cell, Cell]]:
    """The walls as lines between cell corners, merged: collisions with a row of short segments are bumpy."""
    for y in range(maze.rows + 1):
        for begin, end in _runs(maze.passable((x, y - 1), (x, y)) for x in range(maze.columns)):
            yield (begin, y), (end, y)
    for x in range(maze.columns + 1):
        for begin, end in _runs(maze.passable((x - 1, y), (x, y)) for y in range(maze.rows)):
            yield (x, begin), (x, end)


def _runs(passable: Iterator[bool]) -> Iterator[tuple[int, int]]:
    """(begin, end) of each run of consecutive walls."""
    end = 0
    for gap, places in itertools.groupby(passable):
        begin, end = end, end + len(list(places))
        if not gap:
            yield begin, end


def _neighbors(maze: Grid, cell: Cell) -> Iterator[Cell]:
    x, y = cell
    return filter(maze.inside, ((x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)))
