"""A pond with turtles that come and go: the world of the official tutorials."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from sim.world.bodies import Body
from sim.world.drawing import Colour, Drawing
from sim.world.machines.canvas import SIDE, Canvas
from sim.world.machines.machine import Machine, Pose, Site
from sim.world.machines.turtle import STEP, Turtle, single
from sim.world.model import Model, Wanted

_HALF = (
    (0.5, 0.0), (0.44, 0.08), (0.31, 0.09), (0.36, 0.3), (0.25, 0.37), (0.13, 0.27), (-0.1, 0.29),
    (-0.25, 0.36), (-0.37, 0.29), (-0.3, 0.16), (-0.38, 0.05), (-0.5, 0.0),
)  # fmt: skip
_OUTLINE = (*_HALF, *((x, -y) for x, y in _HALF[-2:0:-1]))
_COLOUR = Wanted(
    "[red, green, blue], each a whole number from 0 to 255", lambda c: all(0 <= v <= 255 for v in c)
)


@dataclass(frozen=True)
class PondModel(Model):
    """A pond of 11.09 m by 11.09 m, in whose middle a turtle waits.

    Attributes:
        background: the colour of its ground.
    """

    background: Annotated[tuple[int, int, int], _COLOUR] = (69, 86, 255)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The turtle that is there at time 0; those that come later look like it."""
        return (Body("turtle1", "turtle", outline=_OUTLINE),)


class Pond(Machine):
    """The pond under way; `world.machine` is its `PondModel`. Nothing in it is left to chance.

    Attributes:
        turtles: those that are there, by name.
        drawing: what they drew.
    """

    rate = 1 / STEP

    def __init__(self, world: Site, seed: int = 0) -> None:
        super().__init__(world)
        self._canvas, self._now, self._number = Canvas(), 0.0, 0
        self.drawing = Drawing()
        self.drawing.paint(0.0, world.machine.background)
        self.turtles: dict[str, Turtle] = {}
        self._begin()

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The turtles that are there now, by name."""
        (first,) = self.world.machine.bodies
        return tuple(first._replace(name=name) for name in sorted(self.turtles))

    @property
    def poses(self) -> list[Pose]:
        """Where each of `bodies` is, in their order."""
        return [self.turtles[name].pose for name in sorted(self.turtles)]

    def advance(self, until: float) -> None:
        """Do the steps, if any are due, that end at or before `until` (s)."""
        super().advance(until)
        self._now = until

    def command(self, name: str, ahead: float, left: float, turn: float) -> None:
        """Let a turtle move like this (m/s, m/s, rad/s) for a second. Raises CommandError for no numbers."""
        self.turtles[name].command(ahead, left, turn, self._now)

    def free_name(self) -> str:
        """The next name that no turtle here has: turtle1, turtle2 and so on."""
        while True:
            self._number += 1
            if f"turtle{self._number}" not in self.turtles:
                return f"turtle{self._number}"

    def spawn(self, name: str, x: float, y: float, theta: float) -> Turtle:
        """Put a turtle of a new name into the pond, at a place (m) and a heading (rad).

        Raises CommandError for what is not a number.
        """
        pose = single(x), single(y), single(theta)
        turtle = self.turtles[name] = Turtle(name, pose, self._canvas, self.drawing)
        return turtle

    def kill(self, name: str) -> None:
        """Take a turtle out; what it drew stays."""
        del self.turtles[name]

    def clear(self) -> None:
        """Erase all lines."""
        self._canvas.wipe()
        self.drawing.wipe(self._now)
        for turtle in self.turtles.values():
            turtle.begin_anew()

    def reset(self) -> None:
        """As at the beginning, but for the colour of the ground."""
        self.turtles.clear()
        self._number = 0
        self.clear()
        self._begin()

    def paint(self, colour: Colour) -> None:
        """Give the ground another colour."""
        self.drawing.paint(self._now, colour)

    def forget(self) -> None:
        """Drop what can't be seen any more."""
        self.drawing.forget()

    def _begin(self) -> None:
        self.spawn(self.free_name(), SIDE / 2, SIDE / 2, 0.0)

    def _step(self) -> None:
        now = (self._steps + 1) * STEP
        for name in sorted(self.turtles):
            self.turtles[name].step(now)
