"""An inertial measurement unit: what turning and pushing feel like on board."""

from dataclasses import dataclass
from typing import Annotated

from sim.world.model import Model, at_least, within


@dataclass(frozen=True)
class ImuModel(Model):
    """An IMU in the middle of the robot: readings per second, noise and bias of gyro and accelerometer.

    Noise is a standard deviation, for each reading anew. A bias is constant: each axis has its own, drawn
    from the run's seed between minus and plus the figure given here.
    """

    rate: Annotated[float, within(1, 100, "Hz")] = 100.0
    gyro_noise: Annotated[float, at_least(0, "rad/s")] = 0.005
    gyro_bias: Annotated[float, at_least(0, "rad/s")] = 0.02
    accel_noise: Annotated[float, at_least(0, "m/s^2")] = 0.05
    accel_bias: Annotated[float, at_least(0, "m/s^2")] = 0.1
