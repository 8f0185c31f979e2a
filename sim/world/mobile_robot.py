"""One mobile robot of a simulation: its drive and its sensors."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import pymunk

from sim.world.battery import Battery
from sim.world.contacts import Contact, ContactLog
from sim.world.description import World
from sim.world.drive import Drive
from sim.world.imu import Imu, ImuReading
from sim.world.lidar import Lidar, Scan
from sim.world.robot import DT, Pose, wrap

Rows = list[tuple[float, ...]]
_TIRES = 5  # steps of the physics between two looks at the battery


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
        battery: its battery; None where the world's robots never tire.
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
        self.battery = Battery(world.battery, world.chargers[name]) if world.battery else None
        self._lever, self._steps = world.robot.track_width / 2, 0

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

    def command(self, v: float, w: float) -> None:
        """As `Drive` does it, but a robot whose battery is empty stops."""
        super().command(v, w)
        if self.battery and self.battery.is_empty:
            super().command(0.0, 0.0)

    def tire(self) -> None:
        """Drain or fill the battery; call after each step of the space."""
        self._steps += 1
        if self._steps % _TIRES:
            return
        self.battery.work(_TIRES * DT, self.body.position, self.odometry, self._lever)
        if self.battery.is_empty:
            super().command(0.0, 0.0)

    @property
    def sees(self) -> bool:
        """Whether its lidar works now."""
        return self._around.world.lidar.works(self._around.time)

    def scan(self) -> np.ndarray:
        """One new lidar scan from where the lidar truly is: float32, shape (rays,), m; counter-clockwise.

        inf: nothing within `range_max`; -inf: something nearer than `range_min`; nan: no measurement
        (REP-117).
        """
        self._beams.place(*self._around.movers(self))
        place = self._around.world.lidar.place(self.pose)
        ranges = self._beams.measure(*place, self._lidar_rng)
        self.last_scan = Scan(self._around.time, place, ranges)
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
