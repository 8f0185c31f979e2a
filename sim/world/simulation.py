"""Simulates the mobile robots, boxes and people of a world in fixed time steps."""

import functools
import math
from typing import Any

from sim.world.bodies import Body
from sim.world.contacts import Contact, ContactTracker
from sim.world.lidar import Scan
from sim.world.mobile_robot import MobileRobot, Rows
from sim.world.pen_drawing import PenDrawing
from sim.world.people import Obstacle
from sim.world.physics import add_boxes, add_obstacles, add_people, check_start, make_space
from sim.world.robot import DT, RATE, Pose
from sim.world.world import World


class Simulation:
    """The physics of a world with mobile robots, from time 0 on. To restart, construct a new one.

    Equal worlds, seeds and commands at equal times give equal results, bit for bit. The seed is for the
    sensors' noise.

    Attributes:
        robots: all mobile robots by name; the first is "robot", the others are in the world's order.
        robot: the first robot.

    Raises:
        WorldError: a robot overlaps something at its start, or a box does.
    """

    drawing: PenDrawing | None = None  # robots have no pens
    rate: float = RATE

    def __init__(self, world: World, seed: int = 0) -> None:
        self.world, self.seed = world, seed
        self._steps = 0
        self._space = make_space()
        names = add_obstacles(self._space, world)
        self._boxes = add_boxes(self._space, world, names)
        self._people = add_people(self._space, world, names)
        self.robots: dict[str, MobileRobot] = {}
        for number, name in enumerate(world.starts()):
            check_start(self._space, world, name, names)
            self.robots[name] = robot = MobileRobot(self, self._space, name, number)
            names[robot.shape] = "robot"
        self.robot = self.robots["robot"]
        self._contacts = ContactTracker(
            self._space, {robot.shape: robot.log for robot in self.robots.values()}, names
        )

    @property
    def time(self) -> float:
        """Simulated time of the last physics step, s."""
        return self._steps / RATE

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All moving bodies."""
        return self.world.bodies

    @property
    def poses(self) -> list[Pose]:
        """The pose of each of `bodies`, in their order."""
        moving: tuple[Any, ...] = (*self.robots.values(), *self._boxes, *self._people)
        return [one.pose for one in moving]

    def advance(self, until: float) -> None:
        """Run the physics steps, if any are due, that end at or before `until` (s)."""
        last = math.floor(until * RATE + 1e-6)
        obstacles: list[Obstacle] = [*self.robots.values(), *self._boxes]
        before = [robot.roll for robot in self.robots.values()]
        before += [functools.partial(person.walk, obstacles) for person in self._people]
        after = [robot.update_imu for robot in self.robots.values() if robot.update_imu]
        after += [robot.update_battery for robot in self.robots.values() if robot.battery]
        contacts, step = self._contacts, self._space.step
        while self._steps < last:
            for action in before:
                action()
            step(DT)
            self._steps += 1
            contacts.update(self._steps / RATE)
            for action in after:
                action()

    def moving_obstacles(self, robot: MobileRobot) -> tuple[Rows, Rows]:
        """Obstacles that move around one robot: segments (x0, y0, x1, y1), discs (x, y, radius); m, map."""
        sides: Rows = [side for box in self._boxes for side in box.sides()]
        radius = self.world.robot.radius
        others = (other for other in self.robots.values() if other is not robot)
        people = ((*person.pose[:2], person.shape.radius) for person in self._people)
        return sides, [*((*other.pose[:2], radius) for other in others), *people]

    def place_box(self, name: str, x: float, y: float) -> bool:
        """Put a movable box at (x, y) (m); where something else is, leave it and return False."""
        movable = {f"box_{number}": box for number, box in enumerate(self._boxes, start=1)}
        return name in movable and movable[name].place(x, y)

    @property
    def contacts(self) -> list[Contact]:
        """All contacts of the first robot so far, oldest first."""
        return self.robot.contacts

    @property
    def last_scan(self) -> Scan | None:
        """The first robot's latest scan; None before the first one."""
        return self.robot.last_scan

    def discard_history(self) -> None:
        """Discard the contacts that have ended, to bound the memory of a run without an end."""
        for robot in self.robots.values():
            robot.discard_history()
