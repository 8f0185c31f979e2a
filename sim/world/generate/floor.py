"""Walled floors with obstacles thrown onto them at random."""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Annotated, Any, NamedTuple

from sim.world.generate.card import card, furnished, goal_at
from sim.world.model import Model, within
from sim.world.obstacles import Box, Circle, MovableBox, Point, ring
from sim.world.robot import RobotModel

CLEARANCE = RobotModel().radius + 0.05
"""How far from everything solid there is a way, m: the robot's radius, and a margin."""

_THROWS = 300  # places tried for each obstacle


class _Disc(NamedTuple):
    """The room that something takes up."""

    x: float
    y: float
    radius: float


class FullError(Exception):
    """There is no room for another obstacle."""


@dataclass(frozen=True)
class Room(Model):
    """A walled room with boxes, pillars and boxes that can be pushed; sizes in metres."""

    width: Annotated[float, within(2, 50, "metres")] = 6.0
    height: Annotated[float, within(2, 50, "metres")] = 6.0
    boxes: Annotated[int, within(0, 500)] = 4
    circles: Annotated[int, within(0, 500)] = 2
    movable: Annotated[int, within(0, 100)] = 0

    def draw(self, chance: Random) -> dict[str, Any]:
        """The fields of a world, but its name.

        The way: all obstacles are convex, and further from each other and from the walls than a robot needs
        to pass. So none of them, nor all of them together, can close off a part of the room.
        """
        start, goal = (self._place(chance, side) for side in (0, 1))
        floor = _Floor(self.width, self.height, chance, [_Disc(*start, 0.2), _Disc(*goal, 0.2)])
        largest = min(1.0, min(self.width, self.height) / 6)
        boxes = [_box(floor, chance, 0.3, largest) for _ in range(self.boxes)]
        circles = [_circle(floor, chance, 0.15, largest / 2.5) for _ in range(self.circles)]
        movable = [_box(floor, chance, 0.25, 0.4) for _ in range(self.movable)]
        furniture = furnished(
            ("box", "boxes", self.boxes),
            ("pillar", "pillars", self.circles),
            ("box to push", "boxes to push", self.movable),
        )
        return _floor_fields(self.width, self.height, start, goal, chance) | {
            "boxes": tuple(Box(*box) for box in boxes),
            "circles": tuple(Circle(*circle) for circle in circles),
            "movable": tuple(MovableBox(*box) for box in movable),
            "card": card(
                f"A room of {self.width:g} m by {self.height:g} m with a wall all round{furniture}. "
                f"{goal_at(goal)}.",
                f"In the lower left corner, at x {start[0]:g}, y {start[1]:g}.",
            ),
        }

    def _place(self, chance: Random, side: int) -> Point:
        """Somewhere in the quarter of the room's sides that is next to one corner."""
        return tuple(
            between(chance, 0.3 + (size - 0.6) * 0.75 * side, 0.3 + (size - 0.6) * (0.25 + 0.75 * side))
            for size in (self.width, self.height)
        )


@dataclass(frozen=True)
class Clutter(Model):
    """A walled field full of small pillars and boxes, which cover a share `density` of it."""

    width: Annotated[float, within(2, 50, "metres")] = 8.0
    height: Annotated[float, within(2, 50, "metres")] = 5.0
    density: Annotated[float, within(0, 0.08)] = 0.04

    def draw(self, chance: Random) -> dict[str, Any]:
        """The fields of a world, but its name. The way: as in a room."""
        start = 0.4, between(chance, 0.3, self.height - 0.3)
        goal = round(self.width - 0.4, 2), between(chance, 0.3, self.height - 0.3)
        floor = _Floor(self.width, self.height, chance, [_Disc(*start, 0.2), _Disc(*goal, 0.2)])
        boxes, circles, covered = [], [], 0.0
        while covered < self.density * self.width * self.height:
            if chance.random() < 0.5:
                boxes.append(box := Box(*_box(floor, chance, 0.15, 0.35)))
                covered += box.width * box.height
            else:
                circles.append(circle := Circle(*_circle(floor, chance, 0.08, 0.2)))
                covered += math.pi * circle.radius**2
        clutter = furnished(("box", "boxes", len(boxes)), ("pillar", "pillars", len(circles)))
        return _floor_fields(self.width, self.height, start, goal, chance) | {
            "boxes": tuple(boxes),
            "circles": tuple(circles),
            "card": card(
                f"A field of {self.width:g} m by {self.height:g} m with a wall all round{clutter}. "
                f"{goal_at(goal)}.",
                f"At the left wall, at x {start[0]:g}, y {start[1]:g}.",
            ),
        }


class _Floor:
    """Where obstacles are thrown, at random, onto free floor."""

    def __init__(self, width: float, height: float, chance: Random, taken: list[_Disc]) -> None:
        self._size, self._chance, self._taken = (width, height), chance, taken

    def find(self, radius: float) -> Point:
        """A place for an obstacle that fits into this radius (m), a robot's way from everything else."""
        gap = 2 * CLEARANCE + 0.01  # places are rounded to hundredths
        edge = radius + gap
        for _ in range(_THROWS):
            if edge >= min(self._size) / 2:
                break
            x, y = (between(self._chance, edge, size - edge) for size in self._size)
            place = _Disc(x, y, radius)
            if all(_apart(place, other, gap) for other in self._taken):
                self._taken.append(place)
                return x, y
        raise FullError


def _apart(a: _Disc, b: _Disc, gap: float) -> bool:
    dx, dy, least = a.x - b.x, a.y - b.y, a.radius + b.radius + gap
    return dx * dx + dy * dy >= least * least


def _box(floor: _Floor, chance: Random, least: float, most: float) -> tuple[float, ...]:
    width, height = between(chance, least, most), between(chance, least, most)
    place = floor.find(math.sqrt(width * width + height * height) / 2)
    return *place, between(chance, 0, 3), width, height


def _circle(floor: _Floor, chance: Random, least: float, most: float) -> tuple[float, ...]:
    radius = between(chance, least, most)
    return *floor.find(radius), radius


def _floor_fields(width: float, height: float, start: Point, goal: Point, chance: Random) -> dict[str, Any]:
    corners = (0.0, 0.0), (width, 0.0), (width, height), (0.0, height)
    return {
        "bounds": (0.0, 0.0, width, height),
        "start": (*start, between(chance, -3, 3)),
        "goal": goal,
        "walls": ring(corners),
    }


def between(chance: Random, low: float, high: float) -> float:
    """A number between two others, in hundredths: short to read, and equal wherever it is worked out."""
    return round(low + (high - low) * chance.random(), 2)
