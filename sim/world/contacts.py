"""What the robot touched, when, and with which side."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import pymunk

from sim.world.robot import wrap

_ROBOT, _OBSTACLE = 1, 2
_SIDES = ("front", "left", "back", "right")


class Contact(NamedTuple):
    """One touch: when it began and ended (s; end is None while it lasts), and where in the map frame (m).

    `side` is front, left, right or back of the robot; `what` is wall, box or circle.
    """

    stamp: float
    end: float | None
    x: float
    y: float
    side: str
    what: str


class ContactLog:
    """Follows the touches between the robot and the obstacles of a space."""

    def __init__(
        self, space: pymunk.Space, robot: pymunk.Shape, obstacles: Mapping[pymunk.Shape, str]
    ) -> None:
        self._body = robot.body
        self._obstacles = obstacles
        self._touching: dict[pymunk.Shape, int] = {}
        self._notes: list[tuple[pymunk.Shape, bool]] = []
        self.contacts: list[Contact] = []
        robot.collision_type = _ROBOT
        for shape in obstacles:
            shape.collision_type = _OBSTACLE
        # pymunk prints what a callback raises and goes on, so the callbacks only take notes.
        space.on_collision(_ROBOT, _OBSTACLE, begin=self._note_begin, separate=self._note_end)

    def update(self, stamp: float) -> None:
        """Take over what began or ended in the step that ended at `stamp` (s); call after each step."""
        if not self._notes:
            return
        for shape, began in self._notes:
            if began:
                self._touching[shape] = len(self.contacts)
                x, y = self._touch(shape)
                self.contacts.append(Contact(stamp, None, x, y, self._side(x, y), self._obstacles[shape]))
            else:
                index = self._touching.pop(shape)
                self.contacts[index] = self.contacts[index]._replace(end=stamp)
        self._notes.clear()

    @property
    def pressed(self) -> frozenset[str]:
        """The sides of the robot that touch something now."""
        return frozenset(self._side(*self._touch(shape)) for shape in self._touching)

    def _touch(self, shape: pymunk.Shape) -> tuple[float, float]:
        """The point of the obstacle that is nearest to the robot, in the map frame."""
        x, y = shape.point_query(self._body.position).point
        return x, y

    def _side(self, x: float, y: float) -> str:
        position = self._body.position
        bearing = wrap(math.atan2(y - position.y, x - position.x) - self._body.angle)
        return _SIDES[round(bearing / (math.pi / 2)) % 4]

    def _note_begin(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        self._notes.append((arbiter.shapes[1], True))

    def _note_end(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        self._notes.append((arbiter.shapes[1], False))
