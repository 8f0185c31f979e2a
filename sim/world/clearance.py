"""The distance from points to the nearest static obstacle."""

from __future__ import annotations

import math

import numpy as np

from sim.world.world import World

CHUNK = 512  # points; with all walls they fit into a processor's cache


def clearance(world: World, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The distance (m) of points to the nearest static obstacle, 0 inside; arrays of one shape, map frame."""
    gaps = _from_segments(world, x.ravel(), y.ravel()).reshape(x.shape)
    for disc_x, disc_y, radius in world.discs():
        gaps = np.minimum(gaps, np.maximum(np.hypot(x - disc_x, y - disc_y) - radius, 0.0))
    for box in world.boxes:
        c, s = math.cos(box.yaw), math.sin(box.yaw)
        u, v = c * (x - box.x) + s * (y - box.y), c * (y - box.y) - s * (x - box.x)
        gaps[(np.abs(u) < box.width / 2) & (np.abs(v) < box.height / 2)] = 0.0
    return gaps


def _from_segments(world: World, xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
    x0, y0, x1, y1 = world.segments().T[:, :, None]
    ex, ey = x1 - x0, y1 - y0
    gaps = np.full(xs.shape, np.inf)
    for begin in range(0, len(xs) if len(x0) else 0, CHUNK):
        part = slice(begin, begin + CHUNK)
        x, y = xs[part], ys[part]
        along = np.clip(((x - x0) * ex + (y - y0) * ey) / (ex * ex + ey * ey), 0, 1)
        squares = (x0 + along * ex - x) ** 2 + (y0 + along * ey - y) ** 2
        gaps[part] = np.sqrt(squares.min(axis=0))
    return gaps
