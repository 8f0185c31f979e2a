"""A planar lidar that measures segments and discs with numpy."""

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from sim.world.model import Length, Model, at_least, within

# Rays this near (in ray spacings) to a wall's end still meet it: none slips through a shared corner.
_EDGE = 1e-9
# A wall seen end-on, under less than this angle (rad), is invisible: its distance would be rounding noise.
_END_ON = 1e-6


@dataclass(frozen=True)
class LidarModel(Model):
    """A lidar in the middle of the robot: rays per turn, range limits (m), noise's standard deviation (m).

    `dropouts` is the probability that a ray comes back with no measurement.
    """

    rays: Annotated[int, within(1, 10_000)] = 360
    range_min: Annotated[float, at_least(0, "metres")] = 0.12
    range_max: Length = 3.5
    noise: Annotated[float, at_least(0, "metres")] = 0.01
    dropouts: Annotated[float, within(0, 1)] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.range_min >= self.range_max:
            self.refuse("range_min", f"a number below range_max, {self.range_max:g} (metres)")

    @property
    def angle_increment(self) -> float:
        """Angle between two rays, rad."""
        return math.tau / self.rays


class Scan(NamedTuple):
    """One lidar scan: when (s) and from where (map frame) it was taken, and what it measured."""

    stamp: float
    pose: tuple[float, float, float]
    ranges: np.ndarray  # float32, shape (rays,), m


class Lidar:
    """Measures distances from a pose to the obstacles of one world, `segments` and `discs` of `World`.

    All obstacles are worked on at once, each only with the rays inside the angle under which it is seen.
    """

    def __init__(self, model: LidarModel, segments: np.ndarray, discs: np.ndarray) -> None:
        self._model = model
        self._still = len(segments), len(discs)
        self._ends = segments.T.copy()
        self._discs = discs.copy()
        self._split()
        self._nothing = np.full(model.rays, np.inf)
        angles = [ray * model.angle_increment for ray in range(model.rays)]
        # libm, not numpy: numpy's sine differs in the last bit from one kind of processor to the next.
        self._cos = np.array([math.cos(angle) for angle in angles])
        self._sin = np.array([math.sin(angle) for angle in angles])

    def _split(self) -> None:
        self._x0, self._y0, x1, y1 = self._ends
        self._ex, self._ey = x1 - self._x0, y1 - self._y0

    def place(self, segments: list[tuple[float, ...]], discs: list[tuple[float, ...]]) -> None:
        """Put what moves where it is now, beside what stands still.

        segments: (x0, y0, x1, y1), discs: (x, y, radius); m, map frame.
        """
        straight, round_ = self._still
        if segments:
            self._ends = np.concatenate((self._ends[:, :straight], np.array(segments).T), axis=1)
            self._split()
        if discs:
            self._discs = np.concatenate((self._discs[:round_], np.array(discs)))

    def measure(self, x: float, y: float, yaw: float, rng: np.random.Generator) -> np.ndarray:
        """One noisy scan from this pose in the map frame: float32, shape (rays,), m.

        Ray 0 points forward, the others follow counter-clockwise. As REP-117 says, inf means that nothing
        is within `range_max`, -inf that something is nearer than `range_min`, and nan that the ray got lost.
        """
        model = self._model
        ranges = self.distances(x, y, yaw)
        ranges += model.noise * rng.standard_normal(model.rays)
        ranges[ranges > model.range_max] = np.inf
        ranges[ranges < model.range_min] = -np.inf
        if model.dropouts:
            ranges[rng.random(model.rays) < model.dropouts] = np.nan
        return ranges.astype(np.float32)

    def distances(self, x: float, y: float, yaw: float) -> np.ndarray:
        """The true distances from this pose: float64, shape (rays,), m; inf where a ray meets nothing."""
        c, s = math.cos(yaw), math.sin(yaw)
        directions = self._cos * c - self._sin * s, self._sin * c + self._cos * s
        nearest = self._nothing.copy()
        if len(self._ex):
            self._see_segments(nearest, directions, x, y, yaw)
        if len(self._discs):
            self._see_discs(nearest, directions, x, y, yaw)
        return nearest

    def _see_segments(self, nearest: np.ndarray, directions: tuple, x: float, y: float, yaw: float) -> None:
        ax, ay = self._x0 - x, self._y0 - y
        bx, by = ax + self._ex, ay + self._ey
        seen = np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
        first = np.arctan2(ay, ax) - yaw + np.minimum(seen, 0)
        width = np.abs(seen)
        ray, segment = self._pairs(first, width, width > _END_ON)
        area = ax * self._ey - ay * self._ex
        slope = directions[0][ray] * self._ey[segment] - directions[1][ray] * self._ex[segment]
        np.minimum.at(nearest, ray, area[segment] / slope)

    def _see_discs(self, nearest: np.ndarray, directions: tuple, x: float, y: float, yaw: float) -> None:
        cx, cy, radius = self._discs[:, 0] - x, self._discs[:, 1] - y, self._discs[:, 2]
        beyond = cx * cx + cy * cy - radius * radius
        half = np.arctan2(radius, np.sqrt(np.maximum(beyond, 0)))
        ray, disc = self._pairs(np.arctan2(cy, cx) - yaw - half, 2 * half, beyond > 0)
        along = directions[0][ray] * cx[disc] + directions[1][ray] * cy[disc]
        # A ray along the very edge can round to just below zero.
        depth = np.sqrt(np.maximum(along * along - beyond[disc], 0))
        np.minimum.at(nearest, ray, along - depth)

    def _pairs(self, first: np.ndarray, width: np.ndarray, visible: np.ndarray) -> tuple[np.ndarray, ...]:
        """Indices (ray, obstacle) of all rays that can meet an obstacle.

        A visible obstacle fills the angles first .. first + width (rad), counted from ray 0.
        """
        spacing = self._model.angle_increment
        begin = np.ceil(first / spacing - _EDGE).astype(np.intp)
        end = np.floor((first + width) / spacing + _EDGE).astype(np.intp)
        count = np.maximum(end - begin + 1, 0) * visible
        obstacle = np.arange(len(count)).repeat(count)
        shift = begin - (count.cumsum() - count)
        ray = (np.arange(len(obstacle)) + shift[obstacle]) % self._model.rays
        return ray, obstacle
