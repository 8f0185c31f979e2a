"""The mobile robots, boxes and people of one world, moved in fixed steps of simulated time."""

import functools
import math

from sim.world.bodies import Body
from sim.world.contacts import Contact, Touches
from sim.world.description import World
from sim.world.lidar import Scan
from sim.world.mobile_robot import MobileRobot, Rows
from sim.world.robot import DT, RATE, Pose
from sim.world.solids import add_boxes, add_obstacles, add_people, check_start, make_space


class Simulation:
    """The robots in a world, from time 0 on. To start again, make a new one.

    Equal worlds, seeds and commands at equal times give equal results, bit for bit. The seed is for the
    sensors' noise.

    Attributes:
        robots: all mobile robots by name; the first is "robot", the others are in the world's order.
        robot: the first one.

    Raises:
        WorldError: a robot does not fit at its start, or a box is inside something.
    """

    drawing: None = None  # robots have no pen
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
        self._touches = Touches(
            self._space, {robot.shape: robot.log for robot in self.robots.values()}, names
        )

    @property
    def time(self) -> float:
        """Simulated time of the last physics step, s."""
        return self._steps / RATE

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All that moves."""
        return self.world.bodies

    @property
    def poses(self) -> list[Pose]:
        """The pose of each of `bodies`, in their order."""
        moving = (*self.robots.values(), *self._boxes, *self._people)
        return [one.pose for one in moving]

    def advance(self, until: float) -> None:
        """Do the physics steps, if any are due, that end at or before `until` (s)."""
        last = math.floor(until * RATE + 1e-6)
        in_the_way = [*self.robots.values(), *self._boxes]
        before = [robot.roll for robot in self.robots.values()]
        before += [functools.partial(person.walk, in_the_way) for person in self._people]
        after = [robot.feel for robot in self.robots.values() if robot.feel]
        after += [robot.tire for robot in self.robots.values() if robot.battery]
        touches, step = self._touches, self._space.step
        while self._steps < last:
            for roll in before:
                roll()
            step(DT)
            self._steps += 1
            touches.update(self._steps / RATE)
            for feel in after:
                feel()

    def movers(self, robot: MobileRobot) -> tuple[Rows, Rows]:
        """What moves around one robot: segments (x0, y0, x1, y1) and discs (x, y, radius); m, map frame."""
        sides = [side for box in self._boxes for side in box.sides()]
        radius = self.world.robot.radius
        others = (other for other in self.robots.values() if other is not robot)
        people = ((*person.pose[:2], person.shape.radius) for person in self._people)
        return sides, [*((*other.pose[:2], radius) for other in others), *people]

    @property
    def contacts(self) -> list[Contact]:
        """All touches of the first robot so far, oldest first."""
        return self.robot.contacts

    @property
    def last_scan(self) -> Scan | None:
        """What the first robot's lidar saw last; None before the first scan."""
        return self.robot.last_scan

    def forget(self) -> None:
        """Drop the contacts that have ended, for a run without an end."""
        for robot in self.robots.values():
            robot.forget()
