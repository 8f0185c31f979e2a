"""One mobile robot of a simulation: its drive and its sensors."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import pymunk

from sim.world.contacts import Contact, ContactLog
from sim.world.description import World
from sim.world.drive import Drive
from sim.world.imu import Imu, ImuReading
from sim.world.lidar import Lidar, Scan
from sim.world.robot import Pose, wrap

Rows = list[tuple[float, ...]]


class Surroundings(Protocol):
    """What a robot's sensors have to know of the simulation that the robot is in."""

    world: World
    seed: int  # for the sensors' noise

    @property
    def time(self) -> float:
        """Simulated time, s."""

    def movers(self, robot: MobileRobot) -> tuple[Rows, Rows]:
        """What moves around one robot: segments (x0, y0, x1, y1) and discs (x, y, radius); m, map frame."""


class MobileRobot(Drive):
    """A drive with sensors. A `Simulation` makes and moves it; see `Simulation.robots`.

    Attributes:
        name: "robot" for the first one; for any other its name in the world, which is its ROS namespace.
        last_scan: what its lidar saw last; None before the first scan.
    """

    def __init__(self, around: Surroundings, space: pymunk.Space, name: str, number: int) -> None:
        world = around.world
        super().__init__(space, world.robot, world.starts()[name])
        self.name = name
        self.last_scan: Scan | None = None
        self._around = around
        self._beams = Lidar(world.lidar, world.segments(), world.discs())
        self._lidar_rng = _chance(around.seed, (number, 0) if number else ())
        self._imu = Imu(world.imu, self.body, _chance(around.seed, (number, 1))) if world.imu else None
        self.log = ContactLog(self.body)
        self.feel = self._imu.feel if self._imu else None

    @property
    def pose(self) -> Pose:
        """Where the robot truly is: x, y (m) and yaw (rad, in (-pi, pi]) in the map frame."""
        x, y = self.body.position
        return x, y, wrap(self.body.angle)

    @property
    def bumper(self) -> frozenset[str]:
        """The sides that touch something now: any of front, left, right, back."""
        return self.log.pressed

    @property
    def contacts(self) -> list[Contact]:
        """All touches so far, oldest first, but those that `forget` dropped."""
        return list(self.log.contacts)

    def scan(self) -> np.ndarray:
        """One new lidar scan from the true pose: float32, shape (rays,), m; ray 0 forward, counter-clockwise.

        inf: nothing within `range_max`; -inf: something nearer than `range_min`; nan: no measurement
        (REP-117).
        """
        self._beams.place(*self._around.movers(self))
        ranges = self._beams.measure(*self.pose, self._lidar_rng)
        self.last_scan = Scan(self._around.time, self.pose, ranges)
        return ranges

    def imu(self) -> ImuReading | None:
        """What the IMU measured since the last reading; None where the world's robots have no IMU."""
        return self._imu.read(self._around.time) if self._imu else None

    def forget(self) -> None:
        """Drop the contacts that have ended, for a simulation that never does."""
        self.log.forget()


def _chance(seed: int, key: tuple[int, ...]) -> np.random.Generator:
    """A stream of random numbers of its own for each sensor, so that one more changes no other."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=key)))
