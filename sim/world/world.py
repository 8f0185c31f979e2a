"""`World`: a flat world as plain data, read from a TOML file or generated from a seed."""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from sim.suggestions import unknown_name
from sim.world import world_file
from sim.world.battery import BatteryModel
from sim.world.bodies import Body
from sim.world.generate import generate
from sim.world.imu import ImuModel
from sim.world.lidar import LidarModel
from sim.world.obstacles import Box, Circle, MovableBox, Point, Segment
from sim.world.people import Person
from sim.world.robot import OtherRobot, Pose, RobotModel
from sim.world.validated_model import Constraint, Coordinate, Model, WorldError
from sim.world.warehouse import WarehouseModel
from sim.world.wheels import WheelModel

_FOLDER = Path(__file__).parent / "worlds"

_BOUNDS = "[xmin, ymin, xmax, ymax] (meters) with xmin < xmax and ymin < ymax"
_WALLS = f"a list of walls, each a list of {world_file.CORNERS}"
_MACHINES = tuple(world_file.MACHINES.values())
_MACHINE = Constraint(
    f"one of {', '.join(model.__name__ for model in _MACHINES)}", lambda model: type(model) in _MACHINES
)
_NOT_MOBILE = {
    **{"robot": RobotModel(), "lidar": LidarModel(), "wheels": None, "imu": None},
    **{"battery": None, "warehouse": None},
    **{"movable": (), "robots": (), "people": ()},
}
_Bounds = tuple[Coordinate, Coordinate, Coordinate, Coordinate]


@dataclass(frozen=True)
class World(Model):
    """A flat world; lengths in meters, angles in radians, all in the map frame.

    Attributes:
        name: the file's name without `.toml`.
        card: the description for users, one line each for Picture, Topics, Frames and units, Start, Ends
        when.
        bounds: (xmin, ymin, xmax, ymax) of the area that pictures show; the border is no wall by itself.
        start: (x, y, yaw) of the robot at time 0.
        goal: (x, y), or None if the world has no goal.
        walls: thin straight walls, each ((x0, y0), (x1, y1)).
        boxes, circles: the static obstacles.
        movable: the boxes that can be pushed.
        robots: the further robots, besides the first one, which is named "robot".
        people: the people who walk around.
        robot, lidar: the parameters of the robots and of their lidars.
        wheels: the errors of the robots' wheels; None if they have none.
        imu: the parameters of the robots' IMUs; None if they have none.
        battery: the parameters of the robots' batteries, and the first robot's charger; None if the robots
        have
            no batteries.
        warehouse: where orders are picked up and delivered; None without orders.
        machine: the model of a machine that takes the place of mobile robots, or None.

    Raises:
        ModelError: a value is invalid.
    """

    name: str
    card: str
    bounds: Annotated[_Bounds, Constraint(_BOUNDS, lambda b: b[0] < b[2] and b[1] < b[3])]
    start: Annotated[Pose, Constraint("[x, y, yaw] (meters and radians) inside the bounds")] = (0.0, 0.0, 0.0)
    goal: Annotated[Point, Constraint("[x, y] (meters) inside the bounds")] | None = None
    walls: Annotated[tuple[Segment, ...], Constraint(_WALLS, lambda all_: all(a != b for a, b in all_))] = ()
    boxes: Annotated[tuple[Box, ...], Constraint("a list of Box")] = ()
    circles: Annotated[tuple[Circle, ...], Constraint("a list of Circle")] = ()
    movable: Annotated[tuple[MovableBox, ...], Constraint("a list of MovableBox")] = ()
    robots: Annotated[tuple[OtherRobot, ...], Constraint("a list of OtherRobot")] = ()
    people: Annotated[tuple[Person, ...], Constraint("a list of Person")] = ()
    robot: RobotModel = field(default_factory=RobotModel)
    lidar: LidarModel = field(default_factory=LidarModel)
    wheels: WheelModel | None = None
    imu: ImuModel | None = None
    battery: BatteryModel | None = None
    warehouse: WarehouseModel | None = None
    machine: Annotated[Any, _MACHINE] | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for key in ("start", "goal"):
            location = getattr(self, key)
            if location and not self._contains(location):
                self.reject(key)
        x, y, _ = self.lidar.mounted_at((0.0, 0.0, 0.0))
        if math.hypot(x, y) > self.robot.radius:  # it would measure through walls
            self.reject("lidar", f"a lidar on the robot, whose radius is {self.robot.radius:g} m")
        if self.machine:
            self._reject_mobile_fields()
        self._check_robots()
        if not all(self._contains(corner) for person in self.people for corner in person.route):
            self.reject("people", "routes that lie inside the bounds")
        for key in ("battery", "warehouse"):
            if not all(map(self._contains, self.places(key).values())):
                self.reject(key, "places that lie inside the bounds")

    def _contains(self, location: tuple[float, ...]) -> bool:
        xmin, ymin, xmax, ymax = self.bounds
        return xmin <= location[0] <= xmax and ymin <= location[1] <= ymax

    def _check_robots(self) -> None:
        names = ["robot", *(robot.name for robot in self.robots), *self._box_names(), *self._people_names()]
        for name, again in itertools.pairwise(sorted(names)):
            if name == again:
                self.reject("robots", f"another name for one of those named {name!r}")
        for robot in self.robots:
            if robot.speed > self.robot.max_v:
                self.reject("robots", f"a speed of {self.robot.max_v:g} m/s or less, the robots' max_v")
            if not all(map(self._contains, (robot.start, *robot.route))):
                self.reject("robots", f"a start and a route for {robot.name} that lie inside the bounds")
            if robot.charger and not self.battery:
                self.reject("robots", f"no charger for {robot.name}, where robots have no battery")
            if robot.charger and not self._contains(robot.charger):
                self.reject("robots", f"a charger for {robot.name} that lies inside the bounds")

    def _reject_mobile_fields(self) -> None:
        """Reject parameters of mobile robots next to a machine, instead of silently ignoring them."""
        for key, default in _NOT_MOBILE.items():
            if getattr(self, key) != default:
                self.reject(key, "nothing there, for this world holds a machine instead of a mobile robot")

    @functools.cached_property
    def bodies(self) -> tuple[Body, ...]:
        """All moving bodies, in the order of a simulation's poses; the first robot comes first.

        Turtles can be added and removed during a run: these are the ones at time 0.
        """
        if self.machine:
            return tuple(self.machine.bodies)
        robots = [Body(name, "robot", self.robot.radius) for name in self.starts()]
        boxes = zip(self._box_names(), self.movable, strict=True)
        people = zip(self._people_names(), self.people, strict=True)
        return (
            *robots,
            *(Body(name, "box", outline=box.outline()) for name, box in boxes),
            *(Body(name, "person", person.radius) for name, person in people),
        )

    @property
    def driven_body(self) -> str | None:
        """The robot or turtle that teleop drives, whose poses are a recording's path; None with machines."""
        body = self.bodies[0]
        return body.name if body.kind in ("robot", "turtle") else None

    def starts(self) -> dict[str, Pose]:
        """The start pose of each mobile robot, by name; the first is "robot"."""
        return {"robot": self.start} | {robot.name: robot.start for robot in self.robots}

    @property
    def chargers(self) -> dict[str, Point]:
        """The charger of each mobile robot (m), by the robot's name; empty without batteries."""
        if self.battery is None:
            return {}
        usual = self.battery.charger
        return {"robot": usual} | {robot.name: robot.charger or usual for robot in self.robots}

    def places(self, key: str = "") -> dict[str, tuple[float, ...]]:
        """The named locations: charger, desk, shelf_1, ...; each x, y (m), or x, y and yaw (rad).

        key: "battery" or "warehouse" for the locations of that part only.
        """
        places: dict[str, tuple[float, ...]] = {}
        if self.battery is not None and key != "warehouse":
            places["charger"] = self.battery.charger
            places |= {f"charger_of_{robot.name}": robot.charger for robot in self.robots if robot.charger}
        if self.warehouse is not None and key != "battery":
            places["desk"] = self.warehouse.desk
            places |= {f"shelf_{number}": pose for number, pose in enumerate(self.warehouse.pickups, start=1)}
        return places

    def _box_names(self) -> list[str]:
        return [f"box_{number}" for number in range(1, len(self.movable) + 1)]

    def _people_names(self) -> list[str]:
        return [f"person_{number}" for number in range(1, len(self.people) + 1)]

    @classmethod
    def names(cls) -> list[str]:
        """The names of the course's worlds, sorted."""
        return sorted(path.stem for path in _FOLDER.glob("*.toml"))

    @classmethod
    def load(cls, world: str | Path) -> World:
        """Load one of the course's worlds by name, or a world from the path of a `.toml` file.

        Raises:
            WorldError: no world has this name, or the file cannot be read or has an invalid value.
        """
        path = Path(world)
        return world_file.read(path, cls) if path.suffix == ".toml" else cls._of_the_course(str(world))

    @classmethod
    @functools.cache  # nearly every run loads one
    def _of_the_course(cls, name: str) -> World:
        names = cls.names()
        if name not in names:
            raise WorldError(unknown_name("world", name, names))
        return world_file.read(_FOLDER / f"{name}.toml", cls)

    @classmethod
    def generate(cls, kind: str, *, seed: int = 0, **parameters: Any) -> World:
        """A random world with a path from start to goal; equal arguments give equal worlds.

        kind: "room" (width, height, boxes, circles, movable), "maze" (columns, rows, cell, loops), "clutter"
        (width, height, density) or "warehouse" (columns, rows, movable, people), which has a path to each
        named location; the classes in `sim.world.generate` define the parameters. Its name is such as maze_7.

        Raises:
            WorldError: an unknown kind or parameter, an invalid value, or obstacles that do not fit.
        """
        return cls(**generate(kind, seed, parameters))

    def to_data(self) -> dict[str, Any]:
        """The world as dicts, lists, strings and numbers, for JSON."""
        return world_file.to_data(self, self.machine)

    @classmethod
    def from_data(cls, data: Any) -> World:
        """The world that `to_data` converted to this data.

        Raises:
            WorldError: the data has an invalid key or value.
        """
        return world_file.from_data(data, cls)

    def segments(self) -> np.ndarray:
        """All static straight edges: float64, shape (n, 4), rows x0, y0, x1, y1 (m).

        The walls come first, then the sides of the boxes.
        """
        segments = [*self.walls, *(side for box in self.boxes for side in box.sides())]
        return np.array(segments, dtype=float).reshape(-1, 4)

    def discs(self) -> np.ndarray:
        """All static round obstacles: float64, shape (n, 3), rows x, y, radius (m)."""
        return np.array([(c.x, c.y, c.radius) for c in self.circles], dtype=float).reshape(-1, 3)
