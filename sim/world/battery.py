"""A robot's battery: driving drains it, and a charger fills it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from sim.world.model import Model, positive, within
from sim.world.obstacles import Point
from sim.world.robot import Odometry

NEAR = 0.15
"""How near to a place's point (m) a robot's middle is when the robot is there."""

_HOUR = 3600.0  # s


@dataclass(frozen=True)
class BatteryModel(Model):
    """The battery of each robot of a world (A h, A, V), and the point (m) of the first one's charger.

    `start` is the share of the capacity that is there at time 0. What is taken from it is `idle_current`, and
    `drive_current` for each m/s of the wheels. The voltage falls evenly from `full` to `empty`.
    """

    charger: Point
    capacity: Annotated[float, positive("A h")] = 0.05  # a small one, or a lesson would take hours
    start: Annotated[float, within(0, 1)] = 1.0
    idle_current: Annotated[float, within(0, 1000, "A")] = 0.1
    drive_current: Annotated[float, within(0, 1000, "A for each m/s")] = 0.8
    charge_current: Annotated[float, within(0, 1000, "A")] = 3.0
    empty: Annotated[float, positive("V")] = 11.0
    full: Annotated[float, positive("V")] = 12.6

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.empty >= self.full:
            self.refuse("empty", f"a number below full, {self.full:g} (V)")


class Battery:
    """The battery of one robot, which is filled at a charger (m).

    Attributes:
        charge: what is left in it, A h.
        current: what flows into it, A; below 0 while it is drained.
    """

    def __init__(self, model: BatteryModel, charger: Point) -> None:
        self.model, self.charger = model, charger
        self.charge = model.start * model.capacity
        self.current = -model.idle_current

    @property
    def share(self) -> float:
        """What is left in it, from 0 to 1."""
        return self.charge / self.model.capacity

    @property
    def voltage(self) -> float:
        """Between its poles, V."""
        return self.model.empty + self.share * (self.model.full - self.model.empty)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is left: the motors are off."""
        return self.charge <= 0.0

    def work(self, seconds: float, place: Point, motion: Odometry, lever: float) -> None:
        """So long in a robot that is there, whose wheels, `lever` (m) from its middle, turn so."""
        model = self.model
        if math.dist(place, self.charger) <= NEAR:
            current = model.charge_current if self.charge < model.capacity else 0.0
        else:
            current = -model.idle_current - model.drive_current * max(abs(motion.v), abs(motion.w) * lever)
        self.current = current
        self.charge = min(max(self.charge + current * seconds / _HOUR, 0.0), model.capacity)
