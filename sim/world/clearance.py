"""How far places on a floor are from everything solid that stands still."""

from __future__ import annotations

import math

import numpy as np

from sim.world.description import World


def clearance(world: World, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """For points of the map frame (m), in arrays of one shape: the distance to what is nearest, 0 in it."""
    gaps = np.full(x.shape, np.inf)
    for x0, y0, x1, y1 in world.segments():
        ex, ey = x1 - x0, y1 - y0
        along = np.clip(((x - x0) * ex + (y - y0) * ey) / (ex * ex + ey * ey), 0, 1)
        gaps = np.minimum(gaps, np.hypot(x0 + along * ex - x, y0 + along * ey - y))
    for disc_x, disc_y, radius in world.discs():
        gaps = np.minimum(gaps, np.maximum(np.hypot(x - disc_x, y - disc_y) - radius, 0.0))
    for box in world.boxes:
        c, s = math.cos(box.yaw), math.sin(box.yaw)
        u, v = c * (x - box.x) + s * (y - box.y), c * (y - box.y) - s * (x - box.x)
        gaps[(np.abs(u) < box.width / 2) & (np.abs(v) < box.height / 2)] = 0.0
    return gaps
