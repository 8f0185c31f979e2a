"""What a world is: plain data, read from a small TOML file."""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from sim.suggestions import unknown_name
from sim.world import worldfile
from sim.world.battery import BatteryModel
from sim.world.bodies import Body
from sim.world.generate import generate
from sim.world.imu import ImuModel
from sim.world.lidar import LidarModel
from sim.world.model import Coordinate, Model, Wanted, WorldError
from sim.world.obstacles import Box, Circle, MovableBox, Point, Segment
from sim.world.people import Person
from sim.world.robot import OtherRobot, Pose, RobotModel
from sim.world.warehouse import WarehouseModel

_FOLDER = Path(__file__).parent / "worlds"

_BOUNDS = "[xmin, ymin, xmax, ymax] (metres) with xmin < xmax and ymin < ymax"
_WALLS = f"a list of walls, each a list of {worldfile.CORNERS}"
_MACHINES = tuple(worldfile.MACHINES.values())
_MACHINE = Wanted(
    f"one of {', '.join(model.__name__ for model in _MACHINES)}", lambda model: type(model) in _MACHINES
)
_NOT_MOBILE = {
    **{"robot": RobotModel(), "lidar": LidarModel(), "imu": None, "battery": None, "warehouse": None},
    **{"movable": (), "robots": (), "people": ()},
}
_Bounds = tuple[Coordinate, Coordinate, Coordinate, Coordinate]


@dataclass(frozen=True)
class World(Model):
    """A flat world; lengths in metres, angles in radians, all in the map frame.

    Attributes:
        name: the file's name without `.toml`.
        card: text for people, one line for each of Picture, Topics, Frames and units, Start, Ends when.
        bounds: (xmin, ymin, xmax, ymax) of what is worth drawing; solid only where there are walls.
        start: (x, y, yaw) of the robot at time 0.
        goal: (x, y), or None where the world has none.
        walls: thin straight walls, each ((x0, y0), (x1, y1)).
        boxes, circles: the obstacles that stand still.
        movable: the boxes that can be pushed.
        robots: the robots beside the first one, which is named "robot".
        people: those who walk about.
        robot, lidar: the figures of the robots and their lidars.
        imu: the figures of the robots' IMUs; None where they have none.
        battery: the figures of the robots' batteries, and where the first one's charger is; None where they
            never tire.
        warehouse: where orders are picked up and delivered; None where there are none.
        machine: the model of a machine that stands here instead of mobile robots, or None.

    Raises:
        ModelError: a value cannot be.
    """

    name: str
    card: str
    bounds: Annotated[_Bounds, Wanted(_BOUNDS, lambda b: b[0] < b[2] and b[1] < b[3])]
    start: Annotated[Pose, Wanted("[x, y, yaw] (metres and radians) inside the bounds")] = (0.0, 0.0, 0.0)
    goal: Annotated[Point, Wanted("[x, y] (metres) inside the bounds")] | None = None
    walls: Annotated[tuple[Segment, ...], Wanted(_WALLS, lambda walls: all(a != b for a, b in walls))] = ()
    boxes: Annotated[tuple[Box, ...], Wanted("a list of Box")] = ()
    circles: Annotated[tuple[Circle, ...], Wanted("a list of Circle")] = ()
    movable: Annotated[tuple[MovableBox, ...], Wanted("a list of MovableBox")] = ()
    robots: Annotated[tuple[OtherRobot, ...], Wanted("a list of OtherRobot")] = ()
    people: Annotated[tuple[Person, ...], Wanted("a list of Person")] = ()
    robot: RobotModel = field(default_factory=RobotModel)
    lidar: LidarModel = field(default_factory=LidarModel)
    imu: ImuModel | None = None
    battery: BatteryModel | None = None
    warehouse: WarehouseModel | None = None
    machine: Annotated[Any, _MACHINE] | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for key in ("start", "goal"):
            place = getattr(self, key)
            if place and not self._holds(place):
                self.refuse(key)
        if math.hypot(self.lidar.x, self.lidar.y) > self.robot.radius:  # it could look through a wall
            self.refuse("lidar", f"a lidar on the robot, whose radius is {self.robot.radius:g} m")
        if self.machine:
            self._refuse_mobile()
        self._check_robots()
        if not all(self._holds(corner) for person in self.people for corner in person.route):
            self.refuse("people", "routes that lie inside the bounds")
        for key in ("battery", "warehouse"):
            if not all(map(self._holds, self.places(key).values())):
                self.refuse(key, "places that lie inside the bounds")

    def _holds(self, place: tuple[float, ...]) -> bool:
        xmin, ymin, xmax, ymax = self.bounds
        return xmin <= place[0] <= xmax and ymin <= place[1] <= ymax

    def _check_robots(self) -> None:
        names = ["robot", *(robot.name for robot in self.robots), *self._box_names(), *self._people_names()]
        for name, again in itertools.pairwise(sorted(names)):
            if name == again:
                self.refuse("robots", f"another name for one of those named {name!r}")
        for robot in self.robots:
            if robot.speed > self.robot.max_v:
                self.refuse("robots", f"a speed of {self.robot.max_v:g} m/s or less, the robots' max_v")
            if not all(map(self._holds, (robot.start, *robot.route))):
                self.refuse("robots", f"a start and a route for {robot.name} that lie inside the bounds")
            if robot.charger and not self.battery:
                self.refuse("robots", f"no charger for {robot.name}, where robots have no battery")
            if robot.charger and not self._holds(robot.charger):
                self.refuse("robots", f"a charger for {robot.name} that lies inside the bounds")

    def _refuse_mobile(self) -> None:
        """A machine stands alone: silently leaving out a robot that somebody described would puzzle them."""
        for key, default in _NOT_MOBILE.items():
            if getattr(self, key) != default:
                self.refuse(key, "nothing there, for this world holds a machine instead of a mobile robot")

    @functools.cached_property
    def bodies(self) -> tuple[Body, ...]:
        """All that moves, in the order of a simulation's poses; "robot" comes first where there is one.

        Turtles come and go: these are the ones at time 0.
        """
        if self.machine:
            return self.machine.bodies
        robots = [Body(name, "robot", self.robot.radius) for name in self.starts()]
        boxes = zip(self._box_names(), self.movable, strict=True)
        people = zip(self._people_names(), self.people, strict=True)
        return (
            *robots,
            *(Body(name, "box", outline=box.outline()) for name, box in boxes),
            *(Body(name, "person", person.radius) for name, person in people),
        )

    @property
    def first(self) -> str | None:
        """The robot or turtle that the keys drive, whose way is a recording's path; None with machines."""
        leader = self.bodies[0]
        return leader.name if leader.kind in ("robot", "turtle") else None

    def starts(self) -> dict[str, Pose]:
        """Where each mobile robot is at time 0, by its name; the first is "robot"."""
        return {"robot": self.start} | {robot.name: robot.start for robot in self.robots}

    @property
    def chargers(self) -> dict[str, Point]:
        """Where each mobile robot charges (m), by its name; none where robots never tire."""
        if self.battery is None:
            return {}
        usual = self.battery.charger
        return {"robot": usual} | {robot.name: robot.charger or usual for robot in self.robots}

    def places(self, key: str = "") -> dict[str, tuple[float, ...]]:
        """What has a name on the floor: charger, desk, shelf_1, ...; each x, y (m), or x, y and yaw (rad).

        key: "battery" or "warehouse" for what belongs to that alone.
        """
        chargers: dict[str, Point] = {}
        if self.battery is not None and key != "warehouse":
            own = {f"charger_of_{robot.name}": robot.charger for robot in self.robots if robot.charger}
            chargers = {"charger": self.battery.charger} | own
        if self.warehouse is None or key == "battery":
            return chargers
        shelves = {f"shelf_{number}": pose for number, pose in enumerate(self.warehouse.pickups, start=1)}
        return chargers | {"desk": self.warehouse.desk} | shelves

    def _box_names(self) -> list[str]:
        return [f"box_{number}" for number in range(1, len(self.movable) + 1)]

    def _people_names(self) -> list[str]:
        return [f"person_{number}" for number in range(1, len(self.people) + 1)]

    @classmethod
    def names(cls) -> list[str]:
        """The names of the worlds that come with the course, sorted."""
        return sorted(path.stem for path in _FOLDER.glob("*.toml"))

    @classmethod
    def load(cls, world: str | Path) -> World:
        """Read a world by its name, or from the path of a `.toml` file of your own.

        Raises:
            WorldError: no world has this name, or the file cannot be read or holds a wrong value.
        """
        path = Path(world)
        return worldfile.read(path, cls) if path.suffix == ".toml" else cls._of_the_course(str(world))

    @classmethod
    @functools.cache  # nearly every run begins with one
    def _of_the_course(cls, name: str) -> World:
        names = cls.names()
        if name not in names:
            raise WorldError(unknown_name("world", name, names))
        return worldfile.read(_FOLDER / f"{name}.toml", cls)

    @classmethod
    def generate(cls, kind: str, *, seed: int = 0, **figures: Any) -> World:
        """A world drawn at random, with a way from start to goal; equal arguments give equal worlds.

        kind: "room" (width, height, boxes, circles, movable), "maze" (columns, rows, cell, loops), "clutter"
        (width, height, density) or "warehouse" (columns, rows, movable, people), which has a way to each
        of its places; `sim.world.generate` says what the figures may be. Its name is such as maze_7.

        Raises:
            WorldError: there is no such kind or figure, a figure cannot be, or the obstacles do not fit.
        """
        return cls(**generate(kind, seed, figures))

    def to_data(self) -> dict[str, Any]:
        """All of this world in dicts, lists, texts and numbers, for JSON."""
        return worldfile.to_data(self)

    @classmethod
    def from_data(cls, data: Any) -> World:
        """The world that `to_data` described.

        Raises:
            WorldError: the data holds a wrong key or value.
        """
        return worldfile.from_data(data, cls)

    def segments(self) -> np.ndarray:
        """Everything straight that stands still: float64, shape (n, 4), rows x0, y0, x1, y1 (m).

        The walls come first, then the boxes' sides.
        """
        segments = [*self.walls, *(side for box in self.boxes for side in box.sides())]
        return np.array(segments, dtype=float).reshape(-1, 4)

    def discs(self) -> np.ndarray:
        """Everything round that stands still: float64, shape (n, 3), rows x, y, radius (m)."""
        return np.array([(c.x, c.y, c.radius) for c in self.circles], dtype=float).reshape(-1, 3)
