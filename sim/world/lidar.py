"""A planar lidar that measures distances to segments and discs."""

import math
from dataclasses import dataclass
from typing import Annotated, Any, NamedTuple

import numpy as np
from lidar_rays import ffi, lib

from sim.world.validated_model import Angle, Constraint, Length, Model, at_least, within

NEVER = 1_000_000.0  # s, longer than any run: a transform that is left out
LidarPose = tuple[float, float, float]  # x, y (m), yaw (rad)
Interval = tuple[float, float]  # s; begin included, end excluded


_INTERVALS = "a list of spans [begin, end] (s)"


def _are_intervals(intervals: tuple[Interval, ...]) -> bool:
    return all(0 <= begin < end for begin, end in intervals)


@dataclass(frozen=True)
class LidarModel(Model):
    """A robot's lidar: rays per turn, range limits (m), standard deviation of the noise (m).

    `dropouts` is the probability that a ray has no measurement. `x`, `y` (m) and `yaw` (rad) are the pose of
    base_scan in base_link; by default the robot's center, facing forward. `silent` are the intervals [begin,
    end] (s) without scans. A scan is published `latency` (s) after it is measured, with the next sensors.

    The last five are faults, which no message accounts for: how far off its pose in base_link is (m, m, and
    rad to the left), how far ahead the clock is that stamps its scans (s), and how long after the start the
    robot publishes its transform (s); NEVER leaves it out.
    """

    rays: Annotated[int, within(1, 10_000)] = 360
    range_min: Annotated[float, at_least(0, "meters")] = 0.12
    range_max: Length = 3.5
    noise: Annotated[float, at_least(0, "meters")] = 0.01
    dropouts: Annotated[float, within(0, 1)] = 0.0
    x: Annotated[float, within(-1, 1, "meters")] = 0.0
    y: Annotated[float, within(-1, 1, "meters")] = 0.0
    yaw: Angle = 0.0
    silent: Annotated[tuple[Interval, ...], Constraint(_INTERVALS, _are_intervals)] = ()
    latency: Annotated[float, at_least(0, "s")] = 0.0
    x_error: Annotated[float, within(-1, 1, "meters")] = 0.0
    y_error: Annotated[float, within(-1, 1, "meters")] = 0.0
    yaw_error: Angle = 0.0
    clock_offset: Annotated[float, within(-100, 100, "s")] = 0.0
    transform_delay: Annotated[float, at_least(0, "s")] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.range_min >= self.range_max:
            self.reject("range_min", f"a number below range_max, {self.range_max:g} (meters)")

    @property
    def angle_increment(self) -> float:
        """Angle between two rays, rad."""
        return math.tau / self.rays

    def is_working(self, time: float) -> bool:
        """Return whether it delivers scans at this time (s)."""
        return not any(begin <= time < end for begin, end in self.silent)

    def mounted_at(self, robot: LidarPose) -> LidarPose:
        """The lidar's true pose for a pose of its robot, in the same frame."""
        x, y, yaw = robot
        cos, sin = math.cos(yaw), math.sin(yaw)
        ahead, aside = self.x + self.x_error, self.y + self.y_error
        turned = yaw + (self.yaw + self.yaw_error)
        if not -math.pi < turned <= math.pi:
            turned = math.remainder(turned, math.tau)
        return x + cos * ahead - sin * aside, y + sin * ahead + cos * aside, turned


class Scan(NamedTuple):
    """One lidar scan: its stamp (s), the lidar's pose (map frame) and the measured ranges."""

    stamp: float
    pose: tuple[float, float, float]
    ranges: np.ndarray  # float32, shape (rays,), m


class Lidar:
    """Measures distances from a pose to the obstacles of a world, `segments` and `discs` of `World`."""

    def __init__(self, model: LidarModel, segments: np.ndarray, discs: np.ndarray) -> None:
        self._model = model
        self._static = segments, discs
        self._segments, self._discs = _as_doubles(segments), _as_doubles(discs)
        angles = [ray * model.angle_increment for ray in range(model.rays)]
        # libm, not numpy: the last bit of numpy's sine depends on the processor.
        self._unit = _as_doubles(np.array([(math.cos(angle), math.sin(angle)) for angle in angles]))
        self._distances, self._normal = np.empty(model.rays), np.empty(model.rays)
        self._readings = _as_doubles(self._distances), _as_doubles(self._normal)

    def set_moving_obstacles(self, segments: list[tuple[float, ...]], discs: list[tuple[float, ...]]) -> None:
        """Set the current positions of moving obstacles, in addition to the static ones.

        segments: (x0, y0, x1, y1), discs: (x, y, radius); m, map frame.
        """
        if segments:
            self._segments = _as_doubles(np.concatenate((self._static[0], np.array(segments))))
        if discs:
            self._discs = _as_doubles(np.concatenate((self._static[1], np.array(discs))))

    def measure(self, x: float, y: float, yaw: float, rng: np.random.Generator) -> np.ndarray:
        """One noisy scan from this pose in the map frame: float32, shape (rays,), m.

        Ray 0 points forward, the others follow counter-clockwise. As in REP-117, inf means that nothing is
        within `range_max`, -inf that something is nearer than `range_min`, and nan that the ray has no
        measurement.
        """
        model, rays = self._model, self._model.rays
        self._cast_rays(x, y, yaw)
        rng.standard_normal(out=self._normal)
        ranges = np.empty(rays, np.float32)
        limits = model.noise, model.range_min, model.range_max
        lib.read_ranges(ffi.from_buffer("float[]", ranges), *self._readings, rays, *limits)
        if model.dropouts:
            ranges[rng.random(rays) < model.dropouts] = np.nan
        return ranges

    def distances(self, x: float, y: float, yaw: float) -> np.ndarray:
        """The true distances from this pose: float64, shape (rays,), m; inf if a ray hits nothing."""
        self._cast_rays(x, y, yaw)
        return self._distances.copy()

    def _cast_rays(self, x: float, y: float, yaw: float) -> None:
        segments, discs = (self._segments, len(self._segments) // 4), (self._discs, len(self._discs) // 3)
        lib.see(self._readings[0], self._unit, self._model.rays, *segments, *discs, x, y, yaw)


def _as_doubles(rows: np.ndarray) -> Any:
    """The rows as an argument of `see` in rays/rays.c."""
    return ffi.from_buffer("double[]", np.ascontiguousarray(rows, dtype=np.float64))
