"""People who walk along a route and stop for standing obstacles, but not for moving robots."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, Protocol

import pymunk

from sim.world.obstacles import Point
from sim.world.robot import DT, ROUTE, Pose, is_loop
from sim.world.route import Route
from sim.world.validated_model import Constraint, Length, Model, positive

_LOOK_AHEAD = 0.6  # m from the center; a standing obstacle within it blocks the person
_SIDE_GAP = 0.05  # m; an obstacle with less clearance at the side blocks, too
_TOUCHING = 0.01  # m; an obstacle nearer than this blocks even while it moves
_STANDING = 0.05  # m/s; anything faster counts as moving
_PATIENCE = 4.0  # s until a blocked person turns back
_STEP_MARGIN = 0.1  # m; more than anything moves in one physics step
_STRIDE = 5  # physics steps between two checks for obstacles; the person walks straight in between
_SECONDS = _STRIDE * DT


def _is_route(route: tuple[Point, ...]) -> bool:
    return bool(route) and is_loop(route)


@dataclass(frozen=True)
class Person(Model):
    """A person who walks along a closed `route`, corners (x, y) in the map frame (m), from the first one on.

    A person stops for standing obstacles, not for moving ones, and turns back after four seconds. `speed` is
    in m/s; seen from above a person is a disc (`radius`, m). People cannot be pushed.
    """

    route: Annotated[tuple[Point, ...], Constraint(ROUTE, _is_route)]
    speed: Annotated[float, positive("m/s", 3)] = 1.0
    radius: Length = 0.2


class Obstacle(Protocol):
    """A body that may block a person."""

    @property
    def body(self) -> pymunk.Body:
        """Its body, which has its velocity."""

    @property
    def shape(self) -> pymunk.Shape:
        """Its shape."""


class WalkingPerson:
    """A person in the physics.

    Attributes:
        body, shape: the person in the physics.
    """

    def __init__(self, space: pymunk.Space, person: Person) -> None:
        self._person, self._route = person, Route(person.route)
        self._distance, self._direction = 0.0, 1
        self._steps = self._waited = 0
        self.body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.body.position = person.route[0]
        self.shape = pymunk.Circle(self.body, person.radius)
        self._yaw = 0.0
        space.add(self.body, self.shape)

    @property
    def pose(self) -> Pose:
        """The person's position, x and y (m) in the map frame, and walking direction (rad)."""
        x, y = self.body.position
        return x, y, self._yaw

    def walk(self, obstacles: Iterable[Obstacle]) -> None:
        """Walk, unless an obstacle blocks the person; call before each step of the space."""
        self._steps += 1
        if self._steps % _STRIDE != 1:
            return
        x, y = self.body.position
        if self._is_blocked(x, y, obstacles):
            self.body.velocity = (0.0, 0.0)
            self._waited += 1
            if self._waited * _SECONDS >= _PATIENCE:
                self._waited, self._direction = 0, -self._direction
            return
        self._waited = 0
        stride = self._direction * self._person.speed * _SECONDS
        self._distance = (self._distance + stride) % self._route.length
        next_x, next_y = self._route.point(self._distance)
        self._yaw = math.atan2(next_y - y, next_x - x)
        self.body.velocity = ((next_x - x) / _SECONDS, (next_y - y) / _SECONDS)

    def _is_blocked(self, x: float, y: float, obstacles: Iterable[Obstacle]) -> bool:
        radius = self._person.radius
        reach = self._direction * _LOOK_AHEAD
        ahead = [self._route.point(self._distance + reach * part) for part in (0.5, 1.0)]
        far = radius + _LOOK_AHEAD + _SIDE_GAP + _STEP_MARGIN
        for obstacle in obstacles:
            left, low, right, high = obstacle.shape.bb
            if not (left - far < x < right + far and low - far < y < high + far):
                continue  # most obstacles; a point query takes much longer
            gap = obstacle.shape.point_query((x, y)).distance - radius
            if gap > _LOOK_AHEAD + _SIDE_GAP:
                continue
            if gap < _TOUCHING and self._is_ahead(x, y, obstacle, ahead[0]):
                return True
            if obstacle.body.velocity.length < _STANDING and any(
                obstacle.shape.point_query(point).distance < radius + _SIDE_GAP for point in ahead
            ):
                return True
        return False

    def _is_ahead(self, x: float, y: float, obstacle: Obstacle, point: Point) -> bool:
        there = obstacle.shape.point_query((x, y)).point
        return (there.x - x) * (point[0] - x) + (there.y - y) * (point[1] - y) > 0
