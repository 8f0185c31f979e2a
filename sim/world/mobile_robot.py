"""One mobile robot of a simulation: its drive and its sensors."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pymunk

from sim.world.contacts import Contact, ContactLog
from sim.world.drive import Drive
from sim.world.imu import Imu, ImuReading
from sim.world.lidar import Lidar, Scan
from sim.world.robot import Odometry, Pose, Wheels, wrap

if TYPE_CHECKING:
    from sim.world.simulation import Simulation


class MobileRobot:
    """A robot that drives by commands. A `Simulation` makes and moves it; see `Simulation.robots`.

    Attributes:
        name: "robot" for the first one; for any other its name in the world, which is its ROS namespace.
        last_scan: what its lidar saw last; None before the first scan.
    """

    def __init__(self, simulation: Simulation, space: pymunk.Space, name: str, number: int) -> None:
        world = simulation.world
        self.name = name
        self.last_scan: Scan | None = None
        self._simulation = simulation
        self._drive = Drive(space, world.robot, world.starts()[name])
        self._beams = Lidar(world.lidar, world.segments(), world.discs())
        self._lidar_rng = _chance(simulation.seed, (number, 0) if number else ())
        self._imu = Imu(world.imu, self.body, _chance(simulation.seed, (number, 1))) if world.imu else None
        self.log = ContactLog(self.body)
        self.roll = self._drive.roll
        self.feel = self._imu.feel if self._imu else None

    @property
    def body(self) -> pymunk.Body:
        """Its body in the physics."""
        return self._drive.body

    @property
    def shape(self) -> pymunk.Circle:
        """Its shape in the physics."""
        return self._drive.shape

    @property
    def pose(self) -> Pose:
        """Where the robot truly is: x, y (m) and yaw (rad, in (-pi, pi]) in the map frame."""
        x, y = self.body.position
        return x, y, wrap(self.body.angle)

    @property
    def odometry(self) -> Odometry:
        """Where the wheels say the robot is, from (0, 0, 0) at time 0; wrong once something held it."""
        return self._drive.odometry

    @property
    def wheels(self) -> Wheels:
        """Angles and rates of the two wheel joints."""
        return self._drive.wheels

    @property
    def bumper(self) -> frozenset[str]:
        """The sides that touch something now: any of front, left, right, back."""
        return self.log.pressed

    @property
    def contacts(self) -> list[Contact]:
        """All touches so far, oldest first, but those that `forget` dropped."""
        return list(self.log.contacts)

    def command(self, v: float, w: float) -> None:
        """From now on, drive at v (m/s, forwards) and w (rad/s, counter-clockwise), within the limits.

        The speed ramps up to it. `command_timeout` (s) after the last command it ramps down to 0.

        Raises:
            CommandError: v or w is infinite or not a number.
        """
        self._drive.command(v, w)

    def scan(self) -> np.ndarray:
        """One new lidar scan from the true pose: float32, shape (rays,), m; ray 0 forward, counter-clockwise.

        inf: nothing within `range_max`; -inf: something nearer than `range_min`; nan: no measurement
        (REP-117).
        """
        self._beams.place(*self._simulation.movers(self))
        ranges = self._beams.measure(*self.pose, self._lidar_rng)
        self.last_scan = Scan(self._simulation.time, self.pose, ranges)
        return ranges

    def imu(self) -> ImuReading | None:
        """What the IMU measured since the last reading; None where the world's robots have no IMU."""
        return self._imu.read(self._simulation.time) if self._imu else None

    def forget(self) -> None:
        """Drop the contacts that have ended, for a simulation that never does."""
        self.log.forget()


def _chance(seed: int, key: tuple[int, ...]) -> np.random.Generator:
    """A stream of random numbers of its own for each sensor, so that one more changes no other."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=key)))
