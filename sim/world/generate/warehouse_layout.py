"""Generates warehouses: rows of shelves, with aisles in which a robot and a person can pass each other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random
from typing import Annotated, Any

from sim.world.battery import BatteryModel
from sim.world.generate.card import card, contents
from sim.world.generate.room import uniform
from sim.world.obstacles import Box, MovableBox, Point, ring
from sim.world.people import Person
from sim.world.robot import OtherRobot, Pose
from sim.world.validated_model import Model, within
from sim.world.warehouse import WarehouseModel

_DEPTH, _LENGTH = 0.6, 2.4  # of a shelf, m
_FRONT = 0.8  # m between the left wall and the aisle before the shelves, for the charger and the desk
_CHARGERS = 1.2, 0.8, 0.3  # m; the x of the second robot's charger, the spacing of further ones, their y
_STAND = 0.25  # m from a shelf or desk to the center of a robot in front of it
_TOPICS = (
    "Takes /cmd_vel; gives /odom, /scan, /bumper, /joint_states, /battery_state (sensor_msgs/BatteryState), "
    "/tf, /tf_static (also map to odom) and /clock; and, latched, /map "
    "(nav_msgs/OccupancyGrid, without boxes to push), /dock_pose (geometry_msgs/PoseStamped, the charger) "
    "and /orders (warehouse_msgs/Order)."
)


@dataclass(frozen=True)
class Warehouse(Model):
    """`columns` by `rows` shelves, each with a pickup pose, a desk, chargers, boxes to push and people.

    The boxes to push are at the other sides of the shelves, at most one per shelf. People walk in the middle
    of aisles. Each of the `robots` starts at its charger; the second is named robot_2.
    """

    columns: Annotated[int, within(1, 6)] = 2
    rows: Annotated[int, within(1, 8)] = 3
    movable: Annotated[int, within(0, 48)] = 3
    people: Annotated[int, within(0, 4)] = 1
    robots: Annotated[int, within(1, 3)] = 1

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.movable > self.columns * self.rows:
            self.reject("movable", f"at most {self.columns * self.rows}, one for each shelf")

    def draw(self, rng: Random) -> dict[str, Any]:
        """The fields of a world except its name. Aisles are free; boxes are at their sides."""
        aisle = uniform(rng, 1.5, 1.7)
        width = round(_FRONT + aisle + self.columns * (_LENGTH + aisle), 2)
        height = round(aisle + self.rows * (_DEPTH + aisle), 2)
        shelves = list(self._shelves(rng, aisle))
        upper = [rng.random() < 0.5 for _ in shelves]  # whether the pickup pose is at the upper side
        charger = 0.35, round(height * uniform(rng, 0.15, 0.35), 2)
        desk = round(height * uniform(rng, 0.6, 0.85), 2)
        others = tuple(self._others())
        return {
            "bounds": (0.0, 0.0, width, height),
            "start": (*charger, 0.0),
            "walls": ring(((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))),
            "boxes": (*shelves, Box(0.1, desk, 0.0, 0.2, 0.8)),
            "movable": tuple(self._movable(rng, shelves, upper)),
            "people": tuple(self._person(rng, aisle) for _ in range(self.people)),
            "robots": others,
            "battery": BatteryModel(charger, start=uniform(rng, 0.5, 0.9)),
            "warehouse": WarehouseModel(
                tuple(_pose_at(rng, shelf, above) for shelf, above in zip(shelves, upper, strict=True)),
                (0.2 + _STAND, desk, math.pi),
            ),
            "card": self._card(width, height, charger, desk, others),
        }

    def _others(self) -> Iterator[OtherRobot]:
        """The further robots: at the start of the lower aisle, nearer to the wall than people walk."""
        first, apart, y = _CHARGERS
        for number in range(2, self.robots + 1):
            x = round(first + (number - 2) * apart, 2)
            yield OtherRobot(f"robot_{number}", (x, y, 0.0), charger=(x, y))

    def _shelves(self, rng: Random, aisle: float) -> Iterator[Box]:
        for row in range(self.rows):
            y = aisle + row * (_DEPTH + aisle) + _DEPTH / 2
            for column in range(self.columns):
                left = _FRONT + aisle + column * (_LENGTH + aisle)
                begin, end = left + uniform(rng, 0, 0.4), left + _LENGTH - uniform(rng, 0, 0.4)
                yield Box(round((begin + end) / 2, 3), round(y, 2), 0.0, round(end - begin, 2), _DEPTH)

    def _movable(self, rng: Random, shelves: list[Box], upper: list[bool]) -> Iterator[MovableBox]:
        """Boxes at the sides of shelves without a pickup pose."""
        turns = sorted((rng.random(), index) for index in range(len(shelves)))
        for _, index in turns[: self.movable]:
            x, y, _ = _pose_at(rng, shelves[index], not upper[index])
            sides = uniform(rng, 0.25, 0.35), uniform(rng, 0.25, 0.35)
            yield MovableBox(x, y, 0.0, *sides, mass=uniform(rng, 0.3, 0.8))

    def _person(self, rng: Random, aisle: float) -> Person:
        """A person who walks around a block of shelves."""
        lanes = [_FRONT + aisle / 2 + column * (_LENGTH + aisle) for column in range(self.columns + 1)]
        aisles = [aisle / 2 + row * (_DEPTH + aisle) for row in range(self.rows + 1)]
        (left, right), (low, high) = (_two_of(rng, lines) for lines in (lanes, aisles))
        corners = [(right, low), (right, high), (left, high), (left, low)]
        if rng.random() < 0.5:
            corners = [corners[0], *corners[:0:-1]]
        return Person(tuple(corners), speed=uniform(rng, 0.8, 1.2))

    def _card(
        self, width: float, height: float, charger: Point, desk: float, others: tuple[OtherRobot, ...]
    ) -> str:
        things = contents(
            ("shelf", "shelves", self.columns * self.rows),
            ("box to push", "boxes to push", self.movable),
            ("person who walks round", "people who walk round", self.people),
        )
        return card(
            f"A warehouse of {width:g} m by {height:g} m with a wall all round{things}. The charger is at "
            f"x {charger[0]:g}, y {charger[1]:g}, the desk at y {desk:g}; a place lies before each shelf. "
            "People stop for static obstacles, and for nothing that moves.",
            f"At the charger, at x {charger[0]:g}, y {charger[1]:g}, facing along x."
            + "".join(f" {it.name} at its own, at x {it.start[0]:g}, y {it.start[1]:g}." for it in others),
            _TOPICS + "".join(f" {robot.name} has its own under /{robot.name}." for robot in others),
        )


def _pose_at(rng: Random, shelf: Box, above: bool) -> Pose:
    """A random pose at one of a shelf's long sides, facing it."""
    x = round(shelf.x + uniform(rng, -0.5, 0.5), 2)
    away = shelf.height / 2 + _STAND
    return x, round(shelf.y + (away if above else -away), 2), -math.pi / 2 if above else math.pi / 2


def _two_of(rng: Random, values: list[float]) -> tuple[float, float]:
    """Two random values out of several, in ascending order."""
    (_, first), (_, second) = sorted((rng.random(), value) for value in values)[:2]
    return round(min(first, second), 2), round(max(first, second), 2)
