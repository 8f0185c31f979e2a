"""A simulated inertial measurement unit (IMU), with noise and bias."""

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np
import pymunk

from sim.world.obstacles import GRAVITY
from sim.world.robot import DT, wrap
from sim.world.validated_model import Model, at_least, within


@dataclass(frozen=True)
class ImuModel(Model):
    """An IMU at the robot's center: rate, noise and bias of gyro and accelerometer.

    Noise is the standard deviation of each reading. A bias is constant and drawn for each axis from the run's
    seed: its absolute value is half to all of the value given here, so there is always a bias.
    """

    rate: Annotated[float, within(1, 100, "Hz")] = 100.0
    gyro_noise: Annotated[float, at_least(0, "rad/s")] = 0.005
    gyro_bias: Annotated[float, at_least(0, "rad/s")] = 0.02
    accel_noise: Annotated[float, at_least(0, "m/s^2")] = 0.05
    accel_bias: Annotated[float, at_least(0, "m/s^2")] = 0.1


class ImuReading(NamedTuple):
    """One reading: its stamp (s), and measurements in base_link.

    `yaw` is the integrated turning rate, rad in (-pi, pi], 0 at the start; it drifts as on a real IMU. `w` is
    the turning rate (rad/s, counter-clockwise). `ax`, `ay`, `az` are the accelerometer's readings (m/s^2, x
    forward, y left, z up): the robot's acceleration, and the reaction to gravity.
    """

    stamp: float
    yaw: float
    w: float
    ax: float
    ay: float
    az: float


class Imu:
    """Measures the motion of a body step by step, with noise and bias.

    A reading is the mean over the steps since the last one, like the filter of a real IMU; so low rates miss
    no impact.
    """

    def __init__(self, model: ImuModel, body: pymunk.Body, rng: np.random.Generator) -> None:
        self._model, self._body, self._rng = model, body, rng
        self._gyro_bias = _random_bias(rng, model.gyro_bias)
        self._accel_bias = [_random_bias(rng, model.accel_bias) for _ in "xyz"]
        self._velocity = body.velocity
        self._angle = body.angle
        self._forward = self._left = 0.0  # sums of velocity changes, m/s
        self._steps = 0
        self._reading: ImuReading | None = None

    def update(self) -> None:
        """Add the last step; call after each step of the space."""
        body = self._body
        before, self._velocity = self._velocity, body.velocity
        dx, dy = self._velocity.x - before.x, self._velocity.y - before.y
        c, s = math.cos(body.angle), math.sin(body.angle)
        self._forward += c * dx + s * dy
        self._left += c * dy - s * dx
        self._steps += 1

    def read(self, stamp: float) -> ImuReading:
        """The reading at `stamp` (s); the previous reading if there was no step since."""
        if self._reading and not self._steps:
            return self._reading
        yaw = self._reading.yaw if self._reading else 0.0
        elapsed = self._steps * DT
        w = (self._body.angle - self._angle) / elapsed if elapsed else 0.0
        forward, left = (self._forward / elapsed, self._left / elapsed) if elapsed else (0.0, 0.0)
        noise = self._rng.standard_normal(4).tolist()
        w += self._gyro_bias + self._model.gyro_noise * noise[0]
        ax, ay, az = (
            true + bias + self._model.accel_noise * error
            for true, bias, error in zip((forward, left, GRAVITY), self._accel_bias, noise[1:], strict=True)
        )
        self._angle = self._body.angle
        self._forward = self._left = 0.0
        self._steps = 0
        self._reading = ImuReading(stamp, wrap(yaw + w * elapsed), w, ax, ay, az)
        return self._reading


def _random_bias(rng: np.random.Generator, most: float) -> float:
    """A bias whose absolute value is half to all of `most`."""
    drawn = rng.uniform(-most, most)
    return math.copysign((most + abs(drawn)) / 2, drawn)
