"""Mazes: cells of a grid, with walls between some neighbours and none between others."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random
from typing import Annotated, Any, NamedTuple

from sim.world.generate.card import card, goal_at
from sim.world.model import Model, within

Cell = tuple[int, int]
"""(column, row), from the lower left."""


class Grid(NamedTuple):
    """A maze: its size, and all pairs of neighbours without a wall between them, left or lower one first."""

    columns: int
    rows: int
    open: frozenset[tuple[Cell, Cell]]

    def inside(self, cell: Cell) -> bool:
        """Whether there is such a cell."""
        return 0 <= cell[0] < self.columns and 0 <= cell[1] < self.rows

    def passable(self, a: Cell, b: Cell) -> bool:
        """Whether one can go from a cell to its neighbour, of which one may be outside."""
        return ((a, b) if a < b else (b, a)) in self.open


@dataclass(frozen=True)
class Maze(Model):
    """Cells of `cell` metres, of which each can be reached.

    `loops` is the share of the walls inside that are opened again: with 0 there is one way to each cell.
    """

    columns: Annotated[int, within(2, 40)] = 6
    rows: Annotated[int, within(2, 40)] = 6
    cell: Annotated[float, within(0.4, 5, "metres")] = 1.0
    loops: Annotated[float, within(0, 1)] = 0.0

    def draw(self, chance: Random) -> dict[str, Any]:
        """The fields of a world, but its name. The way: corridors are as wide as cells."""
        maze = grow(self.columns, self.rows, self.loops, chance)
        way = longest_way(maze, (0, 0))
        width, height, cell = self.columns * self.cell, self.rows * self.cell, self.cell
        (x, y), goal = (((column + 0.5) * cell, (row + 0.5) * cell) for column, row in (way[0], way[-1]))
        upwards = way[1][1] > way[0][1]
        walls = [((x0 * cell, y0 * cell), (x1 * cell, y1 * cell)) for (x0, y0), (x1, y1) in merged(maze)]
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


def grow(columns: int, rows: int, loops: float, chance: Random) -> Grid:
    """A maze in which one can get from each cell to each, in just one way unless there are `loops`.

    loops: the share of the remaining inner walls that are opened too, each at random.
    """
    closed = Grid(columns, rows, frozenset())
    passages: set[tuple[Cell, Cell]] = set()
    seen, trail = {(0, 0)}, [(0, 0)]
    while trail:
        here = trail[-1]
        fresh = [cell for cell in _neighbours(closed, here) if cell not in seen]
        if not fresh:
            trail.pop()
            continue
        there = fresh[math.floor(chance.random() * len(fresh))]
        passages.add((min(here, there), max(here, there)))
        seen.add(there)
        trail.append(there)
    for column in range(columns):
        for row in range(rows):
            here = column, row
            for there in ((column + 1, row), (column, row + 1)):
                if closed.inside(there) and (here, there) not in passages and chance.random() < loops:
                    passages.add((here, there))
    return Grid(columns, rows, frozenset(passages))


def longest_way(maze: Grid, start: Cell) -> list[Cell]:
    """The shortest way from this cell to the one that is farthest to go to."""
    came_from: dict[Cell, Cell | None] = {start: None}
    queue = [start]
    for here in queue:
        for there in _neighbours(maze, here):
            if there not in came_from and maze.passable(here, there):
                came_from[there] = here
                queue.append(there)
    way = [queue[-1]]
    while (before := came_from[way[-1]]) is not None:
        way.append(before)
    return way[::-1]


def merged(maze: Grid) -> Iterator[tuple[Cell, Cell]]:
    """The walls as lines between corners of cells, as long as can be: a row of short ones is bumpy."""
    for y in range(maze.rows + 1):
        for begin, end in _runs(maze.passable((x, y - 1), (x, y)) for x in range(maze.columns)):
            yield (begin, y), (end, y)
    for x in range(maze.columns + 1):
        for begin, end in _runs(maze.passable((x - 1, y), (x, y)) for y in range(maze.rows)):
            yield (x, begin), (x, end)


def _runs(passable: Iterator[bool]) -> Iterator[tuple[int, int]]:
    """(begin, end) of each row of walls without a gap."""
    end = 0
    for gap, places in itertools.groupby(passable):
        begin, end = end, end + len(list(places))
        if not gap:
            yield begin, end


def _neighbours(maze: Grid, cell: Cell) -> Iterator[Cell]:
    x, y = cell
    return filter(maze.inside, ((x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)))
