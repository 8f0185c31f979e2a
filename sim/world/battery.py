"""A robot's battery: driving discharges it, a charger charges it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from sim.world.obstacles import Point
from sim.world.robot import Odometry
from sim.world.validated_model import Model, positive, within

NEAR = 0.15
"""A robot is at a location if its center is within this distance (m)."""

_HOUR = 3600.0  # s


@dataclass(frozen=True)
class BatteryModel(Model):
    """Parameters of the robots' batteries (A h, A, V), and the position (m) of the first robot's charger.

    `start` is the charge at time 0 as a fraction of the capacity. The discharge current is `idle_current`
    plus `drive_current` per m/s of the wheels. The voltage falls linearly with the charge from `full` to
    `empty`.
    """

    charger: Point
    capacity: Annotated[float, positive("A h")] = 0.05  # small, so that a lesson doesn't take hours
    start: Annotated[float, within(0, 1)] = 1.0
    idle_current: Annotated[float, within(0, 1000, "A")] = 0.1
    drive_current: Annotated[float, within(0, 1000, "A for each m/s")] = 0.8
    charge_current: Annotated[float, within(0, 1000, "A")] = 3.0
    empty: Annotated[float, positive("V")] = 11.0
    full: Annotated[float, positive("V")] = 12.6

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.empty >= self.full:
            self.reject("empty", f"a number below full, {self.full:g} (V)")


class Battery:
    """The battery of one robot, charged at the position `charger` (m).

    Attributes:
        charge: the remaining charge, A h.
        current: the charge current, A; negative while discharging.
    """

    def __init__(self, model: BatteryModel, charger: Point) -> None:
        self.model, self.charger = model, charger
        self.charge = model.start * model.capacity
        self.current = -model.idle_current

    @property
    def percentage(self) -> float:
        """The charge as a fraction of the capacity, 0 to 1, as in sensor_msgs/BatteryState."""
        return self.charge / self.model.capacity

    @property
    def voltage(self) -> float:
        """The voltage, V."""
        return self.model.empty + self.percentage * (self.model.full - self.model.empty)

    @property
    def is_empty(self) -> bool:
        """Return whether the charge is 0, which turns the motors off."""
        return self.charge <= 0.0

    def update(self, seconds: float, position: Point, motion: Odometry, lever: float) -> None:
        """Charge or discharge for a time step in a robot at this position with this motion.

        lever: the distance of the wheels from the robot's center, m.
        """
        model = self.model
        if math.dist(position, self.charger) <= NEAR:
            current = model.charge_current if self.charge < model.capacity else 0.0
        else:
            current = -model.idle_current - model.drive_current * max(abs(motion.v), abs(motion.w) * lever)
        self.current = current
        self.charge = min(max(self.charge + current * seconds / _HOUR, 0.0), model.capacity)
