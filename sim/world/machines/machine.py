"""What all machines have in common: they stand at the world's start and move in fixed steps."""

from __future__ import annotations

import math
from typing import Any, Protocol

from sim.world.bodies import Body
from sim.world.contacts import Contact
from sim.world.drawing import Drawing
from sim.world.obstacles import Point
from sim.world.robot import RATE, Pose, wrap


class Site(Protocol):
    """What a machine has to know of the world that it stands in."""

    @property
    def start(self) -> Pose:
        """Where it stands: x, y (m) and yaw (rad) in the map frame."""

    @property
    def machine(self) -> Any:
        """The machine's model."""


class Machine:
    """A machine that is bolted to the ground at `world.start`, from time 0 on: a `Scene`, all but its poses.

    Equal worlds, seeds and commands at equal times give equal results, bit for bit.
    """

    last_scan: None = None  # it has no lidar
    drawing: Drawing | None = None  # it has no pen
    rate: float = RATE  # steps in a second

    def __init__(self, world: Site) -> None:
        self.world = world
        self.robots: dict[str, Any] = {}
        self._steps = 0

    @property
    def time(self) -> float:
        """Simulated time of the last step, s."""
        return self._steps / self.rate

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All that moves."""
        return self.world.machine.bodies

    @property
    def contacts(self) -> list[Contact]:
        """None: there is nothing that a machine could touch."""
        return []

    def forget(self) -> None:
        """Nothing."""

    def advance(self, until: float) -> None:
        """Do the steps, if any are due, that end at or before `until` (s)."""
        last = math.floor(until * self.rate + 1e-6)
        while self._steps < last:
            self._step()
            self._steps += 1

    def _step(self) -> None:
        """Move on by one step."""
        raise NotImplementedError

    def _placed(self, x: float, y: float, yaw: float) -> Pose:
        """A pose in the machine's own frame, given in the map frame."""
        x0, y0, turn = self.world.start
        c, s = math.cos(turn), math.sin(turn)
        return x0 + c * x - s * y, y0 + s * x + c * y, wrap(turn + yaw)


def bar(length: float, thickness: float) -> tuple[Point, ...]:
    """The outline of a bar along x: from the joint at the origin to `length` (m), and around both ends."""
    half = thickness / 2
    return ((-half, -half), (length + half, -half), (length + half, half), (-half, half))
