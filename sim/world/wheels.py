"""Wheels that differ from what the robot assumes: its odometry drifts, and reports how uncertain it is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from sim.world.odometry_covariance import PoseCovariance, PoseSpread, TwistCovariance
from sim.world.robot import DT, Odometry, RobotModel, WheelJoints, wrap
from sim.world.validated_model import Model, within

SLIP_LENGTH = 0.05  # m; over this distance a wheel's slip changes
_STEPS = 5  # physics steps over which a wheel's rate is measured: 0.05 s


@dataclass(frozen=True)
class WheelModel(Model):
    """The errors of the robots' wheels. All are 0 by default: then the odometry is exact.

    The first two are standard deviations of relative errors, drawn from the run's seed: each wheel's radius,
    and the track width. `slip` is the standard deviation of the error in a wheel's distance after it has
    rolled 1 m; it grows with the square root of the distance. An encoder has `ticks` in a turn of its wheel;
    0 stands for one that is exact. The odometry's covariance accounts for these four.

    The last three are faults, which the covariance doesn't account for: the true radius of each wheel, and
    the true track width, over those of the robot's model, which its odometry uses.
    """

    radius_error: Annotated[float, within(0, 0.1)] = 0.0
    track_error: Annotated[float, within(0, 0.1)] = 0.0
    slip: Annotated[float, within(0, 0.03, "meters")] = 0.0
    ticks: Annotated[int, within(0, 100_000)] = 0
    left_scale: Annotated[float, within(0.8, 1.25)] = 1.0
    right_scale: Annotated[float, within(0.8, 1.25)] = 1.0
    track_scale: Annotated[float, within(0.8, 1.25)] = 1.0


class Wheels:
    """The two wheels of one robot with their encoders, advanced step by step by its `Drive`."""

    def __init__(self, model: WheelModel, robot: RobotModel, rng: np.random.Generator) -> None:
        self._model, self._robot, self._rng = model, robot, rng
        left, right, track = rng.standard_normal(3).tolist()
        self._left = model.left_scale * (1 + model.radius_error * left)
        self._right = model.right_scale * (1 + model.radius_error * right)
        self._track = model.track_scale * robot.track_width * (1 + model.track_error * track)
        # The slip varies along the path such that its effect grows as `slip` says.
        self._slip_spread = model.slip / math.sqrt(2 * SLIP_LENGTH)
        self._slips = (self._slip_spread * rng.standard_normal(2)).tolist()
        self._tick = math.tau / model.ticks if model.ticks else 0.0
        self._angles = [0.0, 0.0]  # of the wheels, left and right, rad
        self._read = 0.0, 0.0  # the encoders' last readings, rad
        self._off = [(0.0, 0.0)]  # the errors of the last few readings, the latest last, rad
        self._x, self._y, self._turn = robot.odometry
        self._v = self._w = 0.0
        self._spread = PoseSpread(robot.track_width, model.slip, model.radius_error, model.track_error)

    def count(self, v: float, w: float) -> None:
        """Add a step in which the wheels rolled with these velocities (m/s, rad/s) to the odometry."""
        self._v, self._w = v, w
        radius, track = self._robot.wheel_radius, self._robot.track_width
        for side, speed in enumerate(self._speeds()):
            self._angles[side] += speed * DT / radius
        before, self._read = self._read, (self._reading(0), self._reading(1))
        self._off = [*self._off[-_STEPS:], (self._read[0] - self._angles[0], self._read[1] - self._angles[1])]
        left, right = (radius * (now - then) for now, then in zip(self._read, before, strict=True))
        turn, distance = (right - left) / track, (left + right) / 2
        heading = self._turn + turn / 2
        chord = distance * math.sin(turn / 2) / (turn / 2) if turn else distance  # of the step's arc
        self._x += chord * math.cos(heading)
        self._y += chord * math.sin(heading)
        self._turn += turn
        self._spread.add(left, right, heading)

    def on_ground(self, v: float, w: float) -> tuple[float, float]:
        """The velocity (m/s, rad/s) that the robot really has while its wheels turn as for v and w."""
        self._v, self._w = v, w
        if self._slip_spread:
            noise = self._rng.standard_normal(2).tolist()
            self._slips = [*map(self._next_slip, self._slips, self._speeds(), noise)]
        left, right = self._speeds()
        left *= self._left + self._slips[0]
        right *= self._right + self._slips[1]
        return (left + right) / 2, (right - left) / self._track

    def _next_slip(self, slip: float, speed: float, noise: float) -> float:
        """A wheel's slip after another step; it depends on the distance rolled, not on time."""
        kept = math.exp(-abs(speed) * DT / SLIP_LENGTH)
        return slip * kept + self._slip_spread * math.sqrt(1 - kept * kept) * noise

    def _speeds(self) -> tuple[float, float]:
        """Speeds of the two wheels' rims, m/s."""
        difference = self._w * self._robot.track_width / 2
        return self._v - difference, self._v + difference

    def _reading(self, side: int) -> float:
        """The reading of an encoder, rad."""
        angle, tick = self._angles[side], self._tick
        return math.floor(angle / tick + 0.5) * tick if tick else angle

    def _rates(self) -> tuple[float, float]:
        """Rates of the two wheels as measured, rad/s: from two readings, each off by up to half a tick."""
        radius, seconds = self._robot.wheel_radius, _STEPS * DT
        left, right = (
            speed / radius + (now - then) / seconds
            for speed, now, then in zip(self._speeds(), self._off[-1], self._off[0], strict=True)
        )
        return left, right

    @property
    def odometry(self) -> Odometry:
        """The pose and velocity that the encoders' readings give."""
        left, right = (rate * self._robot.wheel_radius for rate in self._rates())
        v, w = (left + right) / 2, (right - left) / self._robot.track_width
        return Odometry(self._x, self._y, wrap(self._turn), v, w)

    @property
    def joints(self) -> WheelJoints:
        """The encoders' readings."""
        return WheelJoints(*self._read, *self._rates())

    @property
    def pose_covariance(self) -> PoseCovariance:
        """The covariance of the odometry's pose."""
        return self._spread.covariance(self._turn, self._tick * self._robot.wheel_radius / math.sqrt(12))

    @property
    def twist_covariance(self) -> TwistCovariance:
        """The covariance of the odometry's velocity."""
        model, track = self._model, self._robot.track_width
        relative = model.radius_error**2 + self._slip_spread**2
        counted = (self._tick * self._robot.wheel_radius / (_STEPS * DT)) ** 2 / 6
        left, right = (relative * speed**2 + counted for speed in self._speeds())
        turn = (left + right) / track**2 + (model.track_error * self._w) ** 2
        mixed = (right - left) / (2 * track)
        return (left + right) / 4, mixed, mixed, turn
