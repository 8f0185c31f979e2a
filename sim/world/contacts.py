"""The contacts of each robot: what it touched, when, and with which side."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import pymunk

from sim.world.robot import wrap

_ROBOT, _OBSTACLE = 1, 2
_SIDES = ("front", "left", "back", "right")


class Contact(NamedTuple):
    """One contact: when it began and ended (s; end is None while it lasts), and where in the map frame (m).

    `side` is front, left, right or back of the robot; `what` is wall, box, circle, robot or person.
    """

    stamp: float
    end: float | None
    x: float
    y: float
    side: str
    what: str


class ContactLog:
    """The contacts of one robot."""

    def __init__(self, body: pymunk.Body) -> None:
        self._body = body
        self._touching: dict[pymunk.Shape, int] = {}
        self.contacts: list[Contact] = []

    def begin(self, stamp: float, shape: pymunk.Shape, what: str) -> None:
        """From `stamp` (s) on, the robot touches this shape."""
        self._touching[shape] = len(self.contacts)
        x, y = self._contact_point(shape)
        self.contacts.append(Contact(stamp, None, x, y, self._side(x, y), what))

    def end(self, stamp: float, shape: pymunk.Shape) -> None:
        """From `stamp` (s) on, the robot no longer touches this shape."""
        index = self._touching.pop(shape)
        self.contacts[index] = self.contacts[index]._replace(end=stamp)

    def discard_history(self) -> None:
        """Discard the contacts that have ended."""
        ongoing = sorted(self._touching.items(), key=lambda item: item[1])
        self.contacts = [self.contacts[index] for _, index in ongoing]
        self._touching = {shape: index for index, (shape, _) in enumerate(ongoing)}

    @property
    def is_touched(self) -> bool:
        """Return whether something touches the robot now."""
        return bool(self._touching)

    @property
    def touching_sides(self) -> frozenset[str]:
        """The sides of the robot that are in contact now."""
        return frozenset(self._side(*self._contact_point(shape)) for shape in self._touching)

    def _contact_point(self, shape: pymunk.Shape) -> tuple[float, float]:
        """The point of the shape nearest to the robot, in the map frame."""
        x, y = shape.point_query(self._body.position).point
        return x, y

    def _side(self, x: float, y: float) -> str:
        position = self._body.position
        bearing = wrap(math.atan2(y - position.y, x - position.x) - self._body.angle)
        return _SIDES[round(bearing / (math.pi / 2)) % 4]


class ContactTracker:
    """Tracks the contacts of a space and adds them to the logs of the robots.

    names: the kind of every solid shape, robots included.
    """

    def __init__(
        self,
        space: pymunk.Space,
        logs: Mapping[pymunk.Shape, ContactLog],
        names: Mapping[pymunk.Shape, str],
    ) -> None:
        self._logs, self._names = logs, names
        self._events: list[tuple[pymunk.Shape, pymunk.Shape, bool]] = []
        for shape in names:
            shape.collision_type = _ROBOT if shape in logs else _OBSTACLE
        # pymunk prints exceptions of callbacks and continues, so the callbacks only store events.
        for other in (_ROBOT, _OBSTACLE):
            space.on_collision(_ROBOT, other, begin=self._on_begin, separate=self._on_end)

    def update(self, stamp: float) -> None:
        """Log the contacts that began or ended in the step that ends at `stamp` (s); call after each step."""
        if not self._events:
            return
        for first, second, began in self._events:
            for shape, other in ((first, second), (second, first)):
                log = self._logs.get(shape)
                if log and began:
                    log.begin(stamp, other, self._names[other])
                elif log:
                    log.end(stamp, other)
        self._events.clear()

    def _on_begin(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        self._events.append((*arbiter.shapes, True))

    def _on_end(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        self._events.append((*arbiter.shapes, False))
