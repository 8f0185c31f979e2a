"""Sectors of a LaserScan: the rays of one direction, and what they show."""

import math
from typing import Any, NamedTuple

import numpy as np

BESIDE = 60.0  # degrees: as far off may still be taken for the direction
EDGE = 1.0  # degrees: whether a ray so near to a sector's edge belongs to it is left open


class Sector(NamedTuple):
    """The rays of one direction in a scan."""

    rays: np.ndarray  # with those at its edges
    inner: np.ndarray  # without them
    middle: float  # the one ray in the middle
    beside: np.ndarray  # those farther off, up to 60 degrees
    around: float  # the nearest distance of all directions, m
    numbers: np.ndarray  # of `rays`, in the scan

    @property
    def kind(self) -> str:
        """Return what is special in it: near, empty, lost, or plain where nothing is."""
        if np.isneginf(self.rays).any():
            return "near"
        if not np.isfinite(self.rays).any():
            return "empty"
        return "lost" if np.isnan(self.rays).any() else "plain"

    @property
    def nearest(self) -> float:
        """The distance of the nearest thing, m."""
        return max(0.0, _least(self.inner))

    @property
    def text(self) -> str:
        """The end of a sentence on what is special in it, and the first such ray; "" for nothing."""
        if self.kind == "empty":
            return ": there is no ray with a distance"
        marked = np.isneginf(self.rays) if self.kind == "near" else np.isnan(self.rays)
        first = marked.argmax()
        return f": ray {self.numbers[first]} says {self.rays[first]:g}" if marked[first] else ""

    def fits(self, value: float) -> bool:
        """Return whether this is what the rays show."""
        return value == self.nearest or max(0.0, _least(self.rays)) - 0.001 <= value <= self.nearest + 0.001


def _least(rays: np.ndarray) -> float:
    known = rays[~np.isnan(rays)]
    return float(known.min()) if len(known) else math.inf


def sector_of(
    message: Any, middle: float, half: float, *, wraps: bool = True, converts: bool = True
) -> Sector:
    """Return the sector of a scan round a direction: degrees, 0 ahead and 90 to the left.

    half: its width to each side, in degrees.

    wraps, converts: whether 350 is the same angle as -10, and whether angles in rad become degrees.
    """
    ranges = np.array(message.ranges)
    angles = message.angle_min + np.arange(len(ranges)) * message.angle_increment
    off = (np.degrees(angles) if converts else angles) - middle
    off = np.abs((off + 180.0) % 360.0 - 180.0 if wraps else off)
    return Sector(
        ranges[off <= half + EDGE], ranges[off <= half - EDGE], float(ranges[off.argmin()]),
        ranges[(off > half) & (off <= BESIDE)], max(0.0, _least(ranges)), np.flatnonzero(off <= half + EDGE),
    )
