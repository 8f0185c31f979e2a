"""Generators for walled rooms with randomly placed obstacles."""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Annotated, Any, NamedTuple

from sim.world.generate.card import card, contents, goal_at
from sim.world.obstacles import Box, Circle, MovableBox, Point, ring
from sim.world.robot import RobotModel
from sim.world.validated_model import Model, within

CLEARANCE = RobotModel().radius + 0.05
"""Clearance of the free path, m: the robot's radius and a margin."""

_ATTEMPTS = 300  # random positions tried for each obstacle


class _Disc(NamedTuple):
    """The space that an object occupies."""

    x: float
    y: float
    radius: float


class NoSpaceError(Exception):
    """No free space for another obstacle was found."""


@dataclass(frozen=True)
class Room(Model):
    """A walled room with boxes, pillars and boxes that can be pushed; sizes in meters."""

    width: Annotated[float, within(2, 50, "meters")] = 6.0
    height: Annotated[float, within(2, 50, "meters")] = 6.0
    boxes: Annotated[int, within(0, 500)] = 4
    circles: Annotated[int, within(0, 500)] = 2
    movable: Annotated[int, within(0, 100)] = 0

    def draw(self, rng: Random) -> dict[str, Any]:
        """The fields of a world except its name.

        A free path exists because all obstacles are convex and have gaps to each other and to the walls
        through which a robot fits. So obstacles cannot close off a part of the room.
        """
        start, goal = (self._corner_point(rng, side) for side in (0, 1))
        space = _FreeSpace(self.width, self.height, rng, [_Disc(*start, 0.2), _Disc(*goal, 0.2)])
        largest = min(1.0, min(self.width, self.height) / 6)
        boxes = [_box(space, rng, 0.3, largest) for _ in range(self.boxes)]
        circles = [_circle(space, rng, 0.15, largest / 2.5) for _ in range(self.circles)]
        movable = [_box(space, rng, 0.25, 0.4) for _ in range(self.movable)]
        description = contents(
            ("box", "boxes", self.boxes),
            ("pillar", "pillars", self.circles),
            ("box to push", "boxes to push", self.movable),
        )
        return _room_fields(self.width, self.height, start, goal, rng) | {
            "boxes": tuple(Box(*box) for box in boxes),
            "circles": tuple(Circle(*circle) for circle in circles),
            "movable": tuple(MovableBox(*box) for box in movable),
            "card": card(
                f"A room of {self.width:g} m by {self.height:g} m with a wall all round{description}. "
                f"{goal_at(goal)}.",
                f"In the lower left corner, at x {start[0]:g}, y {start[1]:g}.",
            ),
        }

    def _corner_point(self, rng: Random, side: int) -> Point:
        """A random point near a corner, within a quarter of each side length."""
        x, y = (
            uniform(rng, 0.3 + (size - 0.6) * 0.75 * side, 0.3 + (size - 0.6) * (0.25 + 0.75 * side))
            for size in (self.width, self.height)
        )
        return x, y


@dataclass(frozen=True)
class Clutter(Model):
    """A walled field with many small pillars and boxes, which cover the fraction `density` of it."""

    width: Annotated[float, within(2, 50, "meters")] = 8.0
    height: Annotated[float, within(2, 50, "meters")] = 5.0
    density: Annotated[float, within(0, 0.08)] = 0.04

    def draw(self, rng: Random) -> dict[str, Any]:
        """The fields of a world except its name. A free path exists for the same reason as in a room."""
        start = 0.4, uniform(rng, 0.3, self.height - 0.3)
        goal = round(self.width - 0.4, 2), uniform(rng, 0.3, self.height - 0.3)
        space = _FreeSpace(self.width, self.height, rng, [_Disc(*start, 0.2), _Disc(*goal, 0.2)])
        boxes, circles, covered = [], [], 0.0
        while covered < self.density * self.width * self.height:
            if rng.random() < 0.5:
                boxes.append(box := Box(*_box(space, rng, 0.15, 0.35)))
                covered += box.width * box.height
            else:
                circles.append(circle := Circle(*_circle(space, rng, 0.08, 0.2)))
                covered += math.pi * circle.radius**2
        clutter = contents(("box", "boxes", len(boxes)), ("pillar", "pillars", len(circles)))
        return _room_fields(self.width, self.height, start, goal, rng) | {
            "boxes": tuple(boxes),
            "circles": tuple(circles),
            "card": card(
                f"A field of {self.width:g} m by {self.height:g} m with a wall all round{clutter}. "
                f"{goal_at(goal)}.",
                f"At the left wall, at x {start[0]:g}, y {start[1]:g}.",
            ),
        }


class _FreeSpace:
    """Finds random free positions for obstacles."""

    def __init__(self, width: float, height: float, rng: Random, occupied: list[_Disc]) -> None:
        self._size, self._generator, self._occupied = (width, height), rng, occupied

    def find(self, radius: float) -> Point:
        """A position for an obstacle of this radius (m), with a gap for a robot to everything else."""
        gap = 2 * CLEARANCE + 0.01  # positions are rounded to hundredths
        edge = radius + gap
        for _ in range(_ATTEMPTS):
            if edge >= min(self._size) / 2:
                break
            x, y = (uniform(self._generator, edge, size - edge) for size in self._size)
            disc = _Disc(x, y, radius)
            if all(_has_gap(disc, other, gap) for other in self._occupied):
                self._occupied.append(disc)
                return x, y
        raise NoSpaceError


def _has_gap(a: _Disc, b: _Disc, gap: float) -> bool:
    dx, dy, least = a.x - b.x, a.y - b.y, a.radius + b.radius + gap
    return dx * dx + dy * dy >= least * least


def _box(space: _FreeSpace, rng: Random, least: float, most: float) -> tuple[float, ...]:
    width, height = uniform(rng, least, most), uniform(rng, least, most)
    position = space.find(math.sqrt(width * width + height * height) / 2)
    return *position, uniform(rng, 0, 3), width, height


def _circle(space: _FreeSpace, rng: Random, least: float, most: float) -> tuple[float, ...]:
    radius = uniform(rng, least, most)
    return *space.find(radius), radius


def _room_fields(width: float, height: float, start: Point, goal: Point, rng: Random) -> dict[str, Any]:
    corners = (0.0, 0.0), (width, 0.0), (width, height), (0.0, height)
    return {
        "bounds": (0.0, 0.0, width, height),
        "start": (*start, uniform(rng, -3, 3)),
        "goal": goal,
        "walls": ring(corners),
    }


def uniform(rng: Random, low: float, high: float) -> float:
    """A uniformly distributed number, rounded to hundredths: short, and equal on all platforms."""
    return round(low + (high - low) * rng.random(), 2)
