"""A single position-controlled joint with a link."""

from __future__ import annotations

import math

from sim.world.machines.machine import Machine, MachineWorld, Pose
from sim.world.machines.servo import Encoder, Servo
from sim.world.robot import CommandError


class Joint(Machine):
    """The simulated joint; `world.machine` is its `JointModel`. The seed is for the encoder's noise."""

    def __init__(self, world: MachineWorld, seed: int = 0) -> None:
        super().__init__(world)
        self._servo, self._encoder = Servo(world.machine), Encoder(seed)
        self._target = self._servo.position

    @property
    def poses(self) -> list[Pose]:
        """The link's pose in the map frame."""
        return [self._placed(0.0, 0.0, self._servo.position)]

    @property
    def position(self) -> float:
        """The joint's angle (rad), counter-clockwise."""
        return self._servo.position

    @property
    def velocity(self) -> float:
        """The joint's velocity, rad/s."""
        return self._servo.velocity

    def measure(self) -> tuple[float, ...]:
        """The encoder's measurement now: the joint's angle (rad) and velocity (rad/s)."""
        return self._encoder.measure(self._servo)

    def command(self, position: float) -> None:
        """Set the target angle (rad), clamped to the joint's limits.

        Raises:
            CommandError: the position is infinite or not a number.
        """
        if not math.isfinite(position):
            raise CommandError(
                f"Joint commands are finite numbers (rad); this one was {position}: check how it was "
                "calculated."
            )
        self._target = self._servo.clamp(position)

    def _step(self) -> None:
        self._servo.step(self._target)
