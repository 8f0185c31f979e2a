"""The base class of all machines: mounted at the world's start pose, simulated in fixed steps."""

from __future__ import annotations

import math
from typing import Any, Protocol

from sim.world.bodies import Body
from sim.world.contacts import Contact
from sim.world.obstacles import Point
from sim.world.pen_drawing import PenDrawing
from sim.world.robot import RATE, Pose, wrap


class MachineWorld(Protocol):
    """The parts of a world that a machine needs."""

    @property
    def start(self) -> Pose:
        """Its mounting pose: x, y (m) and yaw (rad) in the map frame."""

    @property
    def machine(self) -> Any:
        """The machine's model."""


class Machine:
    """A machine mounted at `world.start`, from time 0 on. Subclasses add poses to make it a `Scene`.

    Equal worlds, seeds and commands at equal times give equal results, bit for bit.
    """

    last_scan: None = None  # machines have no lidar
    drawing: PenDrawing | None = None  # the pens' drawing; None without pens
    rate: float = RATE  # steps per second

    def __init__(self, world: MachineWorld) -> None:
        self.world = world
        self.robots: dict[str, Any] = {}
        self._steps = 0

    @property
    def time(self) -> float:
        """Simulated time of the last step, s."""
        return self._steps / self.rate

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All moving bodies."""
        bodies: tuple[Body, ...] = self.world.machine.bodies
        return bodies

    @property
    def contacts(self) -> list[Contact]:
        """Always empty: machines touch nothing."""
        return []

    def discard_history(self) -> None:
        """Does nothing: machines have no history."""

    def advance(self, until: float) -> None:
        """Run the steps, if any are due, that end at or before `until` (s)."""
        last = math.floor(until * self.rate + 1e-6)
        while self._steps < last:
            self._step()
            self._steps += 1

    def _step(self) -> None:
        """Advance by one step."""
        raise NotImplementedError

    def _placed(self, x: float, y: float, yaw: float) -> Pose:
        """A pose in the machine's own frame, transformed to the map frame."""
        x0, y0, turn = self.world.start
        c, s = math.cos(turn), math.sin(turn)
        return x0 + c * x - s * y, y0 + s * x + c * y, wrap(turn + yaw)


def bar(length: float, thickness: float) -> tuple[Point, ...]:
    """The outline of a bar along x from the origin to `length` (m), extended by half its thickness."""
    half = thickness / 2
    return ((-half, -half), (length + half, -half), (length + half, half), (-half, half))
