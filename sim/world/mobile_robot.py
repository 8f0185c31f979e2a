"""One mobile robot of a simulation: its drive and its sensors."""

from __future__ import annotations

from typing import Protocol

import numpy as np
import pymunk

from sim.world.battery import Battery
from sim.world.contacts import Contact, ContactLog
from sim.world.drive import Drive
from sim.world.imu import Imu, ImuReading
from sim.world.lidar import Lidar, Scan
from sim.world.odometry_covariance import PoseCovariance, TwistCovariance
from sim.world.odometry_error import OdometryError
from sim.world.robot import DT, Pose, wrap
from sim.world.wheels import Wheels
from sim.world.world import World

Rows = list[tuple[float, ...]]
_BATTERY_STEPS = 5  # physics steps between two updates of the battery


class SensorContext(Protocol):
    """The parts of a simulation that the sensors of a robot need."""

    world: World
    seed: int  # for the sensors' noise

    @property
    def time(self) -> float:
        """Simulated time, s."""

    def moving_obstacles(self, robot: MobileRobot) -> tuple[Rows, Rows]:
        """Obstacles that move around one robot: segments (x0, y0, x1, y1), discs (x, y, radius); m, map."""


class MobileRobot(Drive):
    """A differential drive with sensors, constructed and advanced by a `Simulation`; see `Simulation.robots`.

    Attributes:
        name: "robot" for the first one; for any other its name in the world, which is its ROS namespace.
        last_scan: its latest lidar scan; None before the first one.
        odometry_error: how far its odometry may be off.
        battery: its battery; None if the world's robots have none.
    """

    def __init__(self, context: SensorContext, space: pymunk.Space, name: str, number: int) -> None:
        world = context.world
        rng = _generator(context.seed, (number, 2))
        wheels = Wheels(world.wheels, world.robot, rng) if world.wheels else None
        super().__init__(space, world.robot, world.starts()[name], wheels)
        self.name = name
        self.last_scan: Scan | None = None
        self._context = context
        self._lidar = Lidar(world.lidar, world.segments(), world.discs())
        self._lidar_rng = _generator(context.seed, (number, 0) if number else ())
        self._imu = Imu(world.imu, self.body, _generator(context.seed, (number, 1))) if world.imu else None
        self.log = ContactLog(self.body)
        self.update_imu = self._imu.update if self._imu else None
        self.battery = Battery(world.battery, world.chargers[name]) if world.battery else None
        self._lever, self._steps = world.robot.track_width / 2, 0
        self.odometry_error = OdometryError()
        self._carries = sorted(world.robot.carried if number == 0 else (), reverse=True)  # still to come

    @property
    def pose(self) -> Pose:
        """The true pose: x, y (m) and yaw (rad, in (-pi, pi]) in the map frame."""
        x, y = self.body.position
        return x, y, wrap(self.body.angle)

    @property
    def bumper(self) -> frozenset[str]:
        """The sides in contact with something now: any of front, left, right, back."""
        return self.log.touching_sides

    @property
    def contacts(self) -> list[Contact]:
        """All contacts so far, oldest first, except those that `discard_history` removed."""
        return list(self.log.contacts)

    def command(self, v: float, w: float) -> None:
        """Work like `Drive.command`, but a robot with an empty battery stops."""
        super().command(v, w)
        if self.battery and self.battery.is_empty:
            super().command(0.0, 0.0)

    def roll(self) -> None:
        """Work like `Drive.roll`, with what is lost while something touches the robot."""
        self.odometry_error.update(self._v, self._w, self.log.is_touched)
        if self._carries and self._context.time >= self._carries[-1][0]:
            self.place(*self._carries.pop()[1:])
        super().roll()

    @property
    def pose_covariance(self) -> PoseCovariance:
        """The covariance of the odometry's pose, from its wheels and from what has touched the robot."""
        place, turn = self.odometry_error.place**2, self.odometry_error.turn**2
        if self._imperfect is None:
            return place, 0.0, 0.0, 0.0, place, 0.0, 0.0, 0.0, turn
        xx, xy, xt, _, yy, yt, _, _, tt = self._imperfect.pose_covariance
        return xx + place, xy, xt, xy, yy + place, yt, xt, yt, tt + turn

    @property
    def twist_covariance(self) -> TwistCovariance:
        """The covariance of the odometry's velocity, likewise."""
        speed, rate = self.odometry_error.speed**2, self.odometry_error.rate**2
        if self._imperfect is None:
            return speed, 0.0, 0.0, rate
        vv, vw, _, ww = self._imperfect.twist_covariance
        return vv + speed, vw, vw, ww + rate

    def update_battery(self) -> None:
        """Discharge or charge the battery; call after each step of the space."""
        self._steps += 1
        if self._steps % _BATTERY_STEPS or self.battery is None:
            return
        self.battery.update(_BATTERY_STEPS * DT, self.body.position, self.odometry, self._lever)
        if self.battery.is_empty:
            super().command(0.0, 0.0)

    @property
    def lidar_works(self) -> bool:
        """Return whether its lidar delivers scans now."""
        return self._context.world.lidar.is_working(self._context.time)

    def scan(self) -> np.ndarray:
        """A new lidar scan from the lidar's true pose: float32, shape (rays,), m; counter-clockwise.

        inf: nothing within `range_max`; -inf: something nearer than `range_min`; nan: no measurement
        (REP-117).
        """
        self._lidar.set_moving_obstacles(*self._context.moving_obstacles(self))
        pose = self._context.world.lidar.mounted_at(self.pose)
        ranges = self._lidar.measure(*pose, self._lidar_rng)
        self.last_scan = Scan(self._context.time, pose, ranges)
        return ranges

    def imu(self) -> ImuReading | None:
        """The IMU's measurement since the last reading; None if the world's robots have no IMU."""
        return self._imu.read(self._context.time) if self._imu else None

    def discard_history(self) -> None:
        """Discard the contacts that have ended."""
        self.log.discard_history()


def _generator(seed: int, key: tuple[int, ...]) -> np.random.Generator:
    """A separate random generator for each sensor, so that adding a sensor changes no other."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=key)))
