"""Worlds to navigate in, drawn from a seed; one with a box in the way that is in no map."""

from __future__ import annotations

import functools
import math
import random
from dataclasses import replace

from grader.exercises.navigator.ground import Point, drivable, shortest
from sim.world import Box, LidarModel, World

BLOCK = 0.8  # metres; the side of the box in the way
CHEAP = LidarModel(noise=0.03, dropouts=0.05)
ROOM = 0.15  # metres; how far from everything there is still a way past it


@functools.lru_cache(maxsize=64)
def world_of(kind: str, seed: int) -> World:
    """A room, a field of clutter or a maze, with start and goal. The maze is of 5 by 5 cells.

    kind: room, clutter, maze; noisy: a room whose lidar is as bad as a cheap one.
    """
    if kind == "maze":
        return World.generate("maze", seed=seed, columns=5, rows=5, loops=0.1)
    if kind == "noisy":
        world = World.generate("room", seed=seed)
        return replace(world, lidar=CHEAP, name=f"noisy_{seed}")
    return World.generate(kind, seed=seed)


@functools.lru_cache(maxsize=64)
def blocked(seed: int) -> tuple[World, World]:
    """A room as it is, with a box in the way, and the same room as the map has it: without the box.

    The robot's lidar sits a little off its middle, and turned.
    """
    draw = random.Random(f"lidar {seed}")
    turn = draw.choice((-1.0, 1.0)) * round(draw.uniform(1.2, math.pi), 2)
    lidar = replace(CHEAP, x=round(draw.uniform(-0.06, 0.06), 2), y=0.05, yaw=turn)
    for attempt in range(100):
        known = World.generate("room", seed=(seed + attempt * 7919) % 2**32, boxes=3)
        known = replace(known, name=f"blocked_{seed}")
        x, y = _halfway(drivable(known))
        box = Box(x, y, known.start[2], BLOCK, BLOCK)
        real = replace(known, boxes=(*known.boxes, box), lidar=lidar)
        if shortest(real, ROOM) < 1.5 * shortest(known, ROOM):
            return real, known
    raise ValueError(f"seed {seed}: no room could be blocked so that a way is left")


@functools.lru_cache(maxsize=64)
def yard_from(seed: int) -> World:
    """The yard, for a robot that has driven before: it starts where its odometry says. With seed 1, at 0."""
    yard, draw = World.load("yard"), random.Random(f"yard {seed}")
    spot = [round(draw.uniform(low, high), 2) for low, high in ((-2.5, 2.0), (-2.5, 2.0), (-3.0, 3.0))]
    start = (0.0, 0.0, 0.0) if seed == 1 else tuple(spot)
    return replace(yard, start=start, robot=replace(yard.robot, odometry=start))


def _halfway(way: tuple[Point, ...]) -> Point:
    return way[len(way) // 2]
