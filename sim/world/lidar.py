"""A planar lidar that measures segments and discs."""

import math
from dataclasses import dataclass
from typing import Annotated, Any, NamedTuple

import numpy as np
from lidar_rays import ffi, lib

from sim.world.model import Angle, Length, Model, Wanted, at_least, within

Place = tuple[float, float, float]  # x, y (m), yaw (rad)
Span = tuple[float, float]  # s; from when on, and before when


def _are_spans(spans: tuple[Span, ...]) -> bool:
    return all(0 <= begin < end for begin, end in spans)


@dataclass(frozen=True)
class LidarModel(Model):
    """A robot's lidar: rays per turn, range limits (m), noise's standard deviation (m).

    `dropouts` is the probability that a ray comes back with no measurement. `x`, `y` (m) and `yaw` (rad) say
    where it sits on the robot, which is base_scan in base_link; by default in the middle, looking ahead.
    `silent` are spans of time [begin, end] (s) in which it gives no scans.
    """

    rays: Annotated[int, within(1, 10_000)] = 360
    range_min: Annotated[float, at_least(0, "metres")] = 0.12
    range_max: Length = 3.5
    noise: Annotated[float, at_least(0, "metres")] = 0.01
    dropouts: Annotated[float, within(0, 1)] = 0.0
    x: Annotated[float, within(-1, 1, "metres")] = 0.0
    y: Annotated[float, within(-1, 1, "metres")] = 0.0
    yaw: Angle = 0.0
    silent: Annotated[tuple[Span, ...], Wanted("a list of spans [begin, end] (s)", _are_spans)] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.range_min >= self.range_max:
            self.refuse("range_min", f"a number below range_max, {self.range_max:g} (metres)")

    @property
    def angle_increment(self) -> float:
        """Angle between two rays, rad."""
        return math.tau / self.rays

    def works(self, time: float) -> bool:
        """Whether it gives a scan at this time (s)."""
        return not any(begin <= time < end for begin, end in self.silent)

    def place(self, robot: Place) -> Place:
        """Where the lidar is when its robot is there, in the same frame."""
        x, y, yaw = robot
        cos, sin = math.cos(yaw), math.sin(yaw)
        turned = yaw + self.yaw
        if not -math.pi < turned <= math.pi:
            turned = math.remainder(turned, math.tau)
        return x + cos * self.x - sin * self.y, y + sin * self.x + cos * self.y, turned


class Scan(NamedTuple):
    """One lidar scan: when (s) and from where (map frame) it was taken, and what it measured."""

    stamp: float
    pose: tuple[float, float, float]
    ranges: np.ndarray  # float32, shape (rays,), m


class Lidar:
    """Measures distances from a pose to the obstacles of one world, `segments` and `discs` of `World`."""

    def __init__(self, model: LidarModel, segments: np.ndarray, discs: np.ndarray) -> None:
        self._model = model
        self._still = segments, discs
        self._segments, self._discs = _numbers(segments), _numbers(discs)
        angles = [ray * model.angle_increment for ray in range(model.rays)]
        # libm, not numpy: numpy's sine differs in the last bit from one kind of processor to the next.
        self._unit = _numbers(np.array([(math.cos(angle), math.sin(angle)) for angle in angles]))
        self._distances, self._normal = np.empty(model.rays), np.empty(model.rays)
        self._readings = _numbers(self._distances), _numbers(self._normal)

    def place(self, segments: list[tuple[float, ...]], discs: list[tuple[float, ...]]) -> None:
        """Put what moves where it is now, beside what stands still.

        segments: (x0, y0, x1, y1), discs: (x, y, radius); m, map frame.
        """
        if segments:
            self._segments = _numbers(np.concatenate((self._still[0], np.array(segments))))
        if discs:
            self._discs = _numbers(np.concatenate((self._still[1], np.array(discs))))

    def measure(self, x: float, y: float, yaw: float, rng: np.random.Generator) -> np.ndarray:
        """One noisy scan from this pose in the map frame: float32, shape (rays,), m.

        Ray 0 points forward, the others follow counter-clockwise. As REP-117 says, inf means that nothing
        is within `range_max`, -inf that something is nearer than `range_min`, and nan that the ray got lost.
        """
        model, rays = self._model, self._model.rays
        self._see(x, y, yaw)
        rng.standard_normal(out=self._normal)
        ranges = np.empty(rays, np.float32)
        limits = model.noise, model.range_min, model.range_max
        lib.read_ranges(ffi.from_buffer("float[]", ranges), *self._readings, rays, *limits)
        if model.dropouts:
            ranges[rng.random(rays) < model.dropouts] = np.nan
        return ranges

    def distances(self, x: float, y: float, yaw: float) -> np.ndarray:
        """The true distances from this pose: float64, shape (rays,), m; inf where a ray meets nothing."""
        self._see(x, y, yaw)
        return self._distances.copy()

    def _see(self, x: float, y: float, yaw: float) -> None:
        segments, discs = (self._segments, len(self._segments) // 4), (self._discs, len(self._discs) // 3)
        lib.see(self._readings[0], self._unit, self._model.rays, *segments, *discs, x, y, yaw)


def _numbers(rows: np.ndarray) -> Any:
    """The rows as what `see` in rays/rays.c takes."""
    return ffi.from_buffer("double[]", np.ascontiguousarray(rows, dtype=np.float64))
