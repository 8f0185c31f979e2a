"""What a world is: plain data read from a small TOML file."""

import difflib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from sim.world.bodies import Body
from sim.world.lidar import LidarModel
from sim.world.obstacles import Box, Circle, Segment
from sim.world.robot import RobotModel
from sim.world.worldfile import WorldError, read

_FOLDER = Path(__file__).parent / "worlds"


@dataclass(frozen=True)
class World:
    """A flat world that does not move; lengths in metres, angles in radians, all in the map frame.

    Attributes:
        name: the file's name without `.toml`.
        card: text for people, one line for each of Picture, Topics, Frames and units, Start, Ends when.
        bounds: (xmin, ymin, xmax, ymax) of what is worth drawing; solid only where there are walls.
        start: (x, y, yaw) of the robot at time 0.
        goal: (x, y), or None where the world has none.
        walls: thin straight walls, each ((x0, y0), (x1, y1)).
        boxes, circles: the obstacles.
        robot, lidar: the figures of the robot and its lidar.
    """

    name: str
    card: str
    bounds: tuple[float, float, float, float]
    start: tuple[float, float, float]
    goal: tuple[float, float] | None = None
    walls: tuple[Segment, ...] = ()
    boxes: tuple[Box, ...] = ()
    circles: tuple[Circle, ...] = ()
    robot: RobotModel = field(default_factory=RobotModel)
    lidar: LidarModel = field(default_factory=LidarModel)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """All that moves, in the order of a simulation's poses; "robot" comes first where there is one."""
        return (Body("robot", "robot", radius=self.robot.radius),)

    @classmethod
    def names(cls) -> list[str]:
        """The names of the worlds that come with the course, sorted."""
        return sorted(path.stem for path in _FOLDER.glob("*.toml"))

    @classmethod
    def load(cls, world: str | Path) -> "World":
        """Read a world by its name, or from the path of a `.toml` file of your own.

        Raises:
            WorldError: no world has this name, or the file cannot be read or holds a wrong value.
        """
        path = Path(world)
        if path.suffix != ".toml":
            path = cls._path(str(world))
        return cls(name=path.stem, **read(path))

    @classmethod
    def _path(cls, name: str) -> Path:
        names = cls.names()
        if name not in names:
            close = difflib.get_close_matches(name, names, n=1)
            guess = f"Did you mean {close[0]!r}? " if close else ""
            raise WorldError(f"There is no world {name!r}. {guess}The worlds are {', '.join(names)}.")
        return _FOLDER / f"{name}.toml"

    def segments(self) -> np.ndarray:
        """Everything straight: float64, shape (n, 4), rows x0, y0, x1, y1 (m).

        The walls come first, then the boxes' sides.
        """
        segments = [*self.walls, *(side for box in self.boxes for side in box.sides())]
        return np.array(segments, dtype=float).reshape(-1, 4)

    def discs(self) -> np.ndarray:
        """Everything round: float64, shape (n, 3), rows x, y, radius (m)."""
        return np.array(self.circles, dtype=float).reshape(-1, 3)
