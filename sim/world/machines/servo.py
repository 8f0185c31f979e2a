"""A joint with position control: it follows a reference as fast as its limits allow."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from sim.world.bodies import Body
from sim.world.machines.machine import bar
from sim.world.robot import DT
from sim.world.validated_model import Angle, Length, Model, at_least, positive

# Tolerance for a reference that changes velocity with exactly the greatest acceleration.
_ROUNDING = 1 + 1e-9
THICKNESS = 0.06
"""Thickness of a link in pictures, m."""


@dataclass(frozen=True)
class JointModel(Model):
    """One revolute joint and its link (rad, rad/s, rad/s^2, m). At 0 the link is along its parent's x axis.

    Attributes:
        lower, upper: the joint's limits.
        start: its angle at time 0.
        max_velocity, max_acceleration: the motor's limits in either direction.
        length: the link's length, from this joint to the next, or to the tip.
        position_noise, velocity_noise: standard deviations of the encoder's measurements.
    """

    lower: Angle = -math.pi / 2
    upper: Angle = math.pi / 2
    start: Angle = 0.0
    max_velocity: Annotated[float, positive("rad/s", 100)] = 1.0
    max_acceleration: Annotated[float, positive("rad/s^2", 10_000)] = 2.0
    length: Length = 0.5
    position_noise: Annotated[float, at_least(0, "radians")] = 0.0
    velocity_noise: Annotated[float, at_least(0, "rad/s")] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.lower < self.upper:
            self.reject("lower", f"an angle (radians) below upper, which is {self.upper:g}")
        if not self.lower <= self.start <= self.upper:
            self.reject("start", f"an angle (radians) from lower to upper, {self.lower:g} to {self.upper:g}")

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The link, with its x axis from the joint to the tip."""
        return (Body("link", "link", outline=bar(self.length, THICKNESS)),)


class Encoder:
    """Measures joints with the noise of their models; `seed` determines it."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.Generator(np.random.PCG64(seed))

    def measure(self, *servos: Servo) -> tuple[float, ...]:
        """The measured positions (rad), then the velocities (rad/s), of joints."""
        true = [servo.position for servo in servos] + [servo.velocity for servo in servos]
        noise = [servo.model.position_noise for servo in servos]
        noise += [servo.model.velocity_noise for servo in servos]
        if not any(noise):
            return tuple(true)
        errors = self._rng.standard_normal(len(true)).tolist()
        return tuple(value + sigma * error for value, sigma, error in zip(true, noise, errors, strict=True))


class Servo:
    """Position control with a trapezoidal velocity profile: it accelerates at the limit up to the greatest
    velocity towards the reference, and decelerates in time.

    The reference may change at any time: the joint's velocity never jumps, and its position stays within the
    limits.
    """

    def __init__(self, model: JointModel) -> None:
        self.model = model
        self.position = model.start
        self.velocity = 0.0

    def clamp(self, position: float) -> float:
        """The position (rad), clamped to the limits."""
        return min(max(position, self.model.lower), self.model.upper)

    @property
    def stop(self) -> float:
        """The position (rad) at which the joint stops if it decelerates from now on."""
        return self.clamp(self._stop(self.position, self.velocity))

    def step(self, reference: float, rate: float = 0.0) -> None:
        """Advance by one step.

        reference, rate: the joint's reference position (rad) and velocity (rad/s) at the end of the step.
        """
        model, q, v = self.model, self.position, self.velocity
        most = model.max_acceleration * DT
        if self._is_reachable(reference, rate):
            self._set(reference, rate)
            return
        gap = reference - rate * DT - q
        ahead = math.copysign(1.0, gap)
        wanted = rate + ahead * self._speed_within(abs(gap), ahead * (v - rate))
        wanted = min(max(wanted, v - most, -model.max_velocity), v + most, model.max_velocity)
        wanted = min(wanted, self._speed_within(model.upper - q, v))
        wanted = max(wanted, -self._speed_within(q - model.lower, -v))
        self._set(q + (v + wanted) / 2 * DT, wanted)

    def _is_reachable(self, reference: float, rate: float) -> bool:
        """Return whether one step can end exactly there, with enough distance to a limit to decelerate."""
        model, q, v = self.model, self.position, self.velocity
        most = model.max_acceleration * DT
        return (
            abs(reference - q - (v + rate) / 2 * DT) <= most * DT / 2
            and abs(rate - v) <= most * _ROUNDING
            and abs(rate) <= model.max_velocity
            and model.lower <= self._stop(reference, rate) <= model.upper
        )

    def _stop(self, position: float, velocity: float) -> float:
        return position + velocity * abs(velocity) / (2 * self.model.max_acceleration)

    def _speed_within(self, distance: float, speed: float) -> float:
        """The greatest speed after a step, begun at `speed`, from which it can stop within `distance`."""
        limit = self.model.max_acceleration
        rest = distance - speed * DT / 2
        return limit * (math.sqrt(DT * DT / 4 + 2 * rest / limit) - DT / 2) if rest > 0 else 0.0

    def _set(self, position: float, velocity: float) -> None:
        self.position = self.clamp(position)
        self.velocity = velocity if self.position == position else 0.0
