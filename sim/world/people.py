"""People on foot: they walk round a way of their own, and don't look out for moving robots."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, Protocol

import pymunk

from sim.world.model import Length, Model, Wanted, positive
from sim.world.obstacles import Point
from sim.world.robot import DT, ROUTE, Pose, is_loop
from sim.world.route import Route

_LOOKS = 0.6  # m before their middle: what stands there is in the way
_BESIDE = 0.05  # m; what leaves less than this to their side is in the way, too
_TOUCHES = 0.01  # m; what is nearer is in the way even while it moves
_STILL = 0.05  # m/s; what is faster goes its own way, they think
_PATIENCE = 4.0  # s until they turn round
_DRIVEN = 0.1  # m; more than anything moves from one step of the physics to the next
_STRIDE = 5  # steps of the physics; so often a person looks ahead, and goes straight on until then
_SECONDS = _STRIDE * DT


def _is_way(route: tuple[Point, ...]) -> bool:
    return bool(route) and is_loop(route)


@dataclass(frozen=True)
class Person(Model):
    """Somebody who walks round a `route`, corners (x, y) in the map frame (m), from the first one on.

    A person stops for what stands in the way and not for what moves there, and after four seconds turns
    round. `speed` is in m/s; seen from above a person is a disc (`radius`, m). Nobody can push a person.
    """

    route: Annotated[tuple[Point, ...], Wanted(ROUTE, _is_way)]
    speed: Annotated[float, positive("m/s", 3)] = 1.0
    radius: Length = 0.2


class Thing(Protocol):
    """What may stand in the way."""

    body: pymunk.Body
    shape: pymunk.Shape


class Walker:
    """A person in the physics.

    Attributes:
        body, shape: the person in the physics.
    """

    def __init__(self, space: pymunk.Space, person: Person) -> None:
        self._person, self._route = person, Route(person.route)
        self._place, self._direction = 0.0, 1
        self._steps = self._waited = 0
        self.body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.body.position = person.route[0]
        self.shape = pymunk.Circle(self.body, person.radius)
        self._yaw = 0.0
        space.add(self.body, self.shape)

    @property
    def pose(self) -> Pose:
        """Where the person is, x and y (m) in the map frame, and which way (rad) they walk."""
        x, y = self.body.position
        return x, y, self._yaw

    def walk(self, things: Iterable[Thing]) -> None:
        """Walk, unless one of these things is in the way; call before each step of the space."""
        self._steps += 1
        if self._steps % _STRIDE != 1:
            return
        x, y = self.body.position
        if self._is_blocked(x, y, things):
            self.body.velocity = (0.0, 0.0)
            self._waited += 1
            if self._waited * _SECONDS >= _PATIENCE:
                self._waited, self._direction = 0, -self._direction
            return
        self._waited = 0
        self._place = (self._place + self._direction * self._person.speed * _SECONDS) % self._route.length
        next_x, next_y = self._route.point(self._place)
        self._yaw = math.atan2(next_y - y, next_x - x)
        self.body.velocity = ((next_x - x) / _SECONDS, (next_y - y) / _SECONDS)

    def _is_blocked(self, x: float, y: float, things: Iterable[Thing]) -> bool:
        radius = self._person.radius
        ahead = [self._route.point(self._place + self._direction * _LOOKS * part) for part in (0.5, 1.0)]
        far = radius + _LOOKS + _BESIDE + _DRIVEN
        for thing in things:
            left, low, right, high = thing.shape.bb
            if not (left - far < x < right + far and low - far < y < high + far):
                continue  # most things, and a point query takes much longer
            gap = thing.shape.point_query((x, y)).distance - radius
            if gap > _LOOKS + _BESIDE:
                continue
            if gap < _TOUCHES and self._is_ahead(x, y, thing, ahead[0]):
                return True
            if thing.body.velocity.length < _STILL and any(
                thing.shape.point_query(point).distance < radius + _BESIDE for point in ahead
            ):
                return True
        return False

    def _is_ahead(self, x: float, y: float, thing: Thing, point: Point) -> bool:
        there = thing.shape.point_query((x, y)).point
        return (there.x - x) * (point[0] - x) + (there.y - y) * (point[1] - y) > 0
