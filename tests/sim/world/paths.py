"""Whether a robot can get from a world's start to its goal."""

import math

import numpy as np


def clearance(world, step):
    """How far the points of a grid are from everything solid: shape (columns, rows), m."""
    xmin, ymin, xmax, ymax = world.bounds
    px, py = np.meshgrid(np.arange(xmin, xmax, step), np.arange(ymin, ymax, step), indexing="ij")
    gaps = np.full(px.shape, np.inf)
    sides = [side for box in (*world.boxes, *world.movable) for side in box.sides()]
    for (x0, y0), (x1, y1) in (*world.walls, *sides):
        ex, ey = x1 - x0, y1 - y0
        along = np.clip(((px - x0) * ex + (py - y0) * ey) / (ex * ex + ey * ey), 0, 1)
        gaps = np.minimum(gaps, np.hypot(x0 + along * ex - px, y0 + along * ey - py))
    for disc in world.circles:
        gaps = np.minimum(gaps, np.hypot(px - disc.x, py - disc.y) - disc.radius)
    for box in (*world.boxes, *world.movable):
        c, s = math.cos(box.yaw), math.sin(box.yaw)
        u, v = c * (px - box.x) + s * (py - box.y), c * (py - box.y) - s * (px - box.x)
        gaps[(np.abs(u) < box.width / 2) & (np.abs(v) < box.height / 2)] = 0
    return gaps


def has_a_path(world, radius, step=0.04):
    """Whether a disc of this radius (m) can move from start to goal, in steps along the grid.

    Between two points of the grid it comes at most half a step nearer to anything.
    """
    free = clearance(world, step) > radius + step / 2
    place = [
        tuple(round((p - low) / step) for p, low in zip(point[:2], world.bounds[:2], strict=True))
        for point in (world.start, world.goal)
    ]
    reached = np.zeros_like(free)
    reached[place[0]] = free[place[0]]
    count = 0
    while reached.sum() > count:
        count = reached.sum()
        for _ in range(20):
            reached[1:] |= reached[:-1]
            reached[:-1] |= reached[1:]
            reached[:, 1:] |= reached[:, :-1]
            reached[:, :-1] |= reached[:, 1:]
            reached &= free
    return bool(reached[place[1]])
