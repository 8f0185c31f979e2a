"""One robot in one world, moved in fixed steps of simulated time."""

import math

import numpy as np
import pymunk

from sim.world.contacts import Contact, ContactLog
from sim.world.description import World
from sim.world.lidar import Lidar, Scan
from sim.world.model import WorldError
from sim.world.robot import DT, RATE, Drive, Odometry, RobotModel, Wheels, wrap

_STEPS_PER_SAMPLE = round(0.05 * RATE)
_OBSTACLE_FRICTION = 0.5
# How deep touching bodies may overlap (m), for a contact to last; pymunk's own 0.1 suits pixels.
_COLLISION_SLOP = 1e-3
# The share of any deeper overlap that is left after a second: all of it goes in the next step.
_COLLISION_BIAS = 0


class Simulation:
    """The robot in a world, from time 0 on. To start again, make a new one.

    Equal worlds, seeds and commands at equal times give equal results, bit for bit. The seed is for the
    sensors' noise.

    Raises:
        WorldError: the robot does not fit at the world's start.
    """

    def __init__(
        self,
        world: World,
        seed: int = 0,
    ) -> None:
        self.world = world
        self.robot = robot = world.robot
        self.lidar = lidar = world.lidar
        self._space = pymunk.Space()
        self._space.collision_slop = _COLLISION_SLOP
        self._space.collision_bias = _COLLISION_BIAS
        obstacles = _add_obstacles(self._space, world)
        _check_start(self._space, world, robot, obstacles)
        self._drive = Drive(self._space, robot, world.start)
        self._contacts = ContactLog(self._space, self._drive.shape, obstacles)
        self._beams = Lidar(lidar, world.segments(), world.discs())
        self._rng = np.random.Generator(np.random.PCG64(seed))
        self.last_scan: Scan | None = None
        self._steps = 0
        self._path = [(0.0, *self.pose)]

    @property
    def time(self) -> float:
        """Simulated time of the last physics step, s."""
        return self._steps / RATE

    @property
    def radius(self) -> float:
        """The robot's radius, m."""
        return self.robot.radius

    @property
    def pose(self) -> tuple[float, float, float]:
        """Where the robot truly is: x, y (m) and yaw (rad, in (-pi, pi]) in the map frame."""
        x, y = self._drive.body.position
        return x, y, wrap(self._drive.body.angle)

    @property
    def poses(self) -> list[tuple[float, float, float]]:
        """The pose of each of `world.bodies`, in their order."""
        return [self.pose]

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
        return self._contacts.pressed

    @property
    def contacts(self) -> list[Contact]:
        """All touches so far, oldest first."""
        return list(self._contacts.contacts)

    @property
    def path(self) -> list[tuple[float, float, float, float]]:
        """(stamp, x, y, yaw) of the true pose, every 0.05 s from time 0 on."""
        return list(self._path)

    def command(self, v: float, w: float) -> None:
        """From now on, drive at v (m/s, forwards) and w (rad/s, counter-clockwise), within the limits.

        The speed ramps up to it. `robot.command_timeout` (s) after the last command it ramps down to 0.

        Raises:
            CommandError: v or w is infinite or not a number.
        """
        self._drive.command(v, w)

    def advance(self, until: float) -> None:
        """Do the physics steps, if any are due, that end at or before `until` (s)."""
        last = math.floor(until * RATE + 1e-6)
        drive, contacts, step = self._drive, self._contacts, self._space.step
        while self._steps < last:
            drive.roll()
            step(DT)
            self._steps += 1
            contacts.update(self._steps / RATE)
            if self._steps % _STEPS_PER_SAMPLE == 0:
                self._path.append((self.time, *self.pose))

    def scan(self) -> np.ndarray:
        """One new lidar scan from the true pose: float32, shape (rays,), m; ray 0 forward, counter-clockwise.

        inf: nothing within `lidar.range_max`; -inf: something nearer than `lidar.range_min` (REP-117).
        """
        ranges = self._beams.measure(*self.pose, self._rng)
        self.last_scan = Scan(self.time, self.pose, ranges)
        return ranges


def _add_obstacles(space: pymunk.Space, world: World) -> dict[pymunk.Shape, str]:
    """Add the world's solid things in the order of its file, for the order changes the solver's rounding."""
    ground = space.static_body
    shapes: dict[pymunk.Shape, str] = {}
    shapes |= {pymunk.Segment(ground, start, end, 0): "wall" for start, end in world.walls}
    shapes |= {pymunk.Poly(ground, box.corners()): "box" for box in world.boxes}
    shapes |= {
        pymunk.Circle(ground, circle.radius, (circle.x, circle.y)): "circle" for circle in world.circles
    }
    for shape in shapes:
        shape.friction = _OBSTACLE_FRICTION
        space.add(shape)
    return shapes


def _check_start(
    space: pymunk.Space, world: World, robot: RobotModel, obstacles: dict[pymunk.Shape, str]
) -> None:
    x, y, _ = world.start
    hit = space.point_query_nearest((x, y), robot.radius, pymunk.ShapeFilter())
    if hit:
        what = obstacles[hit.shape]
        raise WorldError(
            f"World {world.name!r}: the robot (radius {robot.radius:g} m) does not fit at the start "
            f"({x:g}, {y:g}), where a {what} is; move the start or the {what}."
        )
