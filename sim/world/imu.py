"""An inertial measurement unit: what turning and pushing feel like on board."""

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np
import pymunk

from sim.world.model import Model, at_least, within
from sim.world.obstacles import GRAVITY
from sim.world.robot import DT, wrap


@dataclass(frozen=True)
class ImuModel(Model):
    """An IMU in the middle of the robot: readings per second, noise and bias of gyro and accelerometer.

    Noise is a standard deviation, for each reading anew. A bias is constant: each axis has its own, drawn
    from the run's seed: half to all of the figure given here, to either side. So there always is one.
    """

    rate: Annotated[float, within(1, 100, "Hz")] = 100.0
    gyro_noise: Annotated[float, at_least(0, "rad/s")] = 0.005
    gyro_bias: Annotated[float, at_least(0, "rad/s")] = 0.02
    accel_noise: Annotated[float, at_least(0, "m/s^2")] = 0.05
    accel_bias: Annotated[float, at_least(0, "m/s^2")] = 0.1


class ImuReading(NamedTuple):
    """One reading: when (s), and what an IMU measured in base_link.

    `yaw` is the sum of all measured turns, rad in (-pi, pi], 0 where the robot started; so it drifts as real
    ones do. `w` is the turning rate (rad/s, counter-clockwise). `ax`, `ay`, `az` is what an accelerometer
    feels (m/s^2, x forward, y left, z up): the robot's acceleration, and the floor's push against gravity.
    """

    stamp: float
    yaw: float
    w: float
    ax: float
    ay: float
    az: float


class Imu:
    """Follows a body step by step and measures its motion with noise and bias.

    A reading is the mean over the steps since the last one, as the filters of real IMUs make it; so no push
    is missed at low rates.
    """

    def __init__(self, model: ImuModel, body: pymunk.Body, rng: np.random.Generator) -> None:
        self._model, self._body, self._rng = model, body, rng
        self._gyro_bias = _drawn(rng, model.gyro_bias)
        self._accel_bias = [_drawn(rng, model.accel_bias) for _ in "xyz"]
        self._velocity = body.velocity
        self._angle = body.angle
        self._forward = self._left = 0.0  # sums of velocity changes, m/s
        self._steps = 0
        self._reading: ImuReading | None = None

    def feel(self) -> None:
        """Take in the step that has just been done; call after each step of the space."""
        body = self._body
        before, self._velocity = self._velocity, body.velocity
        dx, dy = self._velocity.x - before.x, self._velocity.y - before.y
        c, s = math.cos(body.angle), math.sin(body.angle)
        self._forward += c * dx + s * dy
        self._left += c * dy - s * dx
        self._steps += 1

    def read(self, stamp: float) -> ImuReading:
        """The reading at `stamp` (s); the same again as long as no step was done."""
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


def _drawn(rng: np.random.Generator, most: float) -> float:
    """A bias from half to all of `most`, to either side."""
    drawn = rng.uniform(-most, most)
    return math.copysign((most + abs(drawn)) / 2, drawn)
