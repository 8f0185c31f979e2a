"""A pond with turtles, as in turtlesim of the official tutorials."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from sim.world.bodies import Body
from sim.world.machines.machine import Machine, MachineWorld, Pose
from sim.world.machines.pond_image import SIDE, PondImage
from sim.world.machines.turtle import STEP, Turtle, as_float32
from sim.world.pen_drawing import Color, PenDrawing
from sim.world.validated_model import Constraint, Model

_HALF = (
    (0.5, 0.0), (0.44, 0.08), (0.31, 0.09), (0.36, 0.3), (0.25, 0.37), (0.13, 0.27), (-0.1, 0.29),
    (-0.25, 0.36), (-0.37, 0.29), (-0.3, 0.16), (-0.38, 0.05), (-0.5, 0.0),
)  # fmt: skip
_OUTLINE = (*_HALF, *((x, -y) for x, y in _HALF[-2:0:-1]))
_COLOR = Constraint(
    "[red, green, blue], each a whole number from 0 to 255", lambda c: all(0 <= v <= 255 for v in c)
)


@dataclass(frozen=True)
class PondModel(Model):
    """A pond of 11.09 m by 11.09 m with a turtle at its center.

    Attributes:
        background: the color of the ground.
    """

    background: Annotated[tuple[int, int, int], _COLOR] = (69, 86, 255)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The turtle at time 0; turtles that are spawned later have the same shape."""
        return (Body("turtle1", "turtle", outline=_OUTLINE),)


class Pond(Machine):
    """The simulated pond; `world.machine` is its `PondModel`. It is deterministic: the seed has no effect.

    Attributes:
        turtles: the current turtles, by name.
        drawing: their lines.
    """

    rate = 1 / STEP

    def __init__(self, world: MachineWorld, seed: int = 0) -> None:
        super().__init__(world)
        self._image, self._now, self._number = PondImage(), 0.0, 0
        self.drawing: PenDrawing = PenDrawing()
        self.drawing.set_ground(0.0, world.machine.background)
        self.turtles: dict[str, Turtle] = {}
        self._begin()

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The current turtles, sorted by name."""
        (first,) = self.world.machine.bodies
        return tuple(first._replace(name=name) for name in sorted(self.turtles))

    @property
    def poses(self) -> list[Pose]:
        """The poses of `bodies`, in their order."""
        return [self.turtles[name].pose for name in sorted(self.turtles)]

    def advance(self, until: float) -> None:
        """Run the steps, if any are due, that end at or before `until` (s)."""
        super().advance(until)
        self._now = until

    def command(self, name: str, ahead: float, left: float, turn: float) -> None:
        """Set a turtle's velocity (m/s, m/s, rad/s) for a second. Raises CommandError for NaN or infinity."""
        self.turtles[name].command(ahead, left, turn, self._now)

    def unused_name(self) -> str:
        """The next unused name: turtle1, turtle2 and so on."""
        while True:
            self._number += 1
            if f"turtle{self._number}" not in self.turtles:
                return f"turtle{self._number}"

    def spawn(self, name: str, x: float, y: float, theta: float) -> Turtle:
        """Add a turtle with a new name at a position (m) and a heading (rad).

        Raises CommandError for NaN or infinity.
        """
        pose = as_float32(x), as_float32(y), as_float32(theta)
        turtle = self.turtles[name] = Turtle(name, pose, self._image, self.drawing)
        return turtle

    def kill(self, name: str) -> None:
        """Remove a turtle; its lines remain."""
        del self.turtles[name]

    def clear(self) -> None:
        """Erase all lines."""
        self._image.erase()
        self.drawing.erase(self._now)
        for turtle in self.turtles.values():
            turtle.break_stroke()

    def reset(self) -> None:
        """Restore the initial state except for the color of the ground."""
        self.turtles.clear()
        self._number = 0
        self.clear()
        self._begin()

    def set_background(self, color: Color) -> None:
        """Change the color of the ground."""
        self.drawing.set_ground(self._now, color)

    def discard_history(self) -> None:
        """Discard lines that are no longer visible."""
        self.drawing.discard_history()

    def _begin(self) -> None:
        self.spawn(self.unused_name(), SIDE / 2, SIDE / 2, 0.0)

    def _step(self) -> None:
        now = (self._steps + 1) * STEP
        for name in sorted(self.turtles):
            self.turtles[name].step(now)
