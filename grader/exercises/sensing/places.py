"""Worlds of 05_sensing, drawn from a seed."""

from __future__ import annotations

import itertools
import math
import random
from dataclasses import replace

import numpy as np

from sim import World
from sim.world import Circle
from sim.world.lidar import Lidar

MARGIN = 0.5  # metres from the wall at which a wall follower starts, and should stay
ROOM_AHEAD, BESIDE = 1.5, 60  # metres that are free at the start, within so many degrees of straight ahead

Rectangle = tuple[float, float, float, float]


def hall(seed: int) -> World:
    """A wide hall: the robot looks along it, and the wall ahead is 3 m to 5 m away, those beside it 2 m."""
    ahead = random.Random(f"hall {seed}").uniform(3.0, 5.0)
    return _walled("hall", seed, (-2.5, -2.0, round(ahead, 2), 2.0), (0.0, 0.0, 0.0), "An empty hall.")


def long_hall(seed: int) -> World:
    """A hall of 18 m, for long drives straight ahead."""
    shift = random.Random(f"long_hall {seed}").uniform(0.0, 0.5)
    bounds = (round(-1.0 - shift, 2), -1.5, 17.0, 1.5)
    return _walled("long_hall", seed, bounds, (0.0, 0.0, 0.0), "A hall of 18 m, without anything in it.")


def gallery(seed: int) -> World:
    """A room with a pillar in its middle. The robot starts at the lower wall, which is on its right."""
    draw = random.Random(f"gallery {seed}")
    width, height = round(draw.uniform(3.6, 5.0), 2), round(draw.uniform(3.2, 4.2), 2)
    start = (round(draw.uniform(0.9, width - 1.9), 2), MARGIN, 0.0)
    world = _walled(
        "gallery", seed, (0.0, 0.0, width, height), start, "A room with a round pillar in its middle."
    )
    return replace(world, circles=(Circle(width / 2, height / 2, 0.3),))


def furnished_room(seed: int) -> World:
    """A room with boxes and pillars."""
    return World.generate("room", seed=seed, boxes=3, circles=2)


def free_start(seed: int) -> World:
    """A furnished room in which the robot looks to where 1.5 m are free, so that a driver can begin."""
    chance = random.Random(f"free_start {seed}")
    for drawn in itertools.chain([seed], iter(lambda: chance.randrange(2**31), None)):
        world = furnished_room(drawn)
        x, y, yaw = world.start
        for turned in (yaw, *(math.radians(degrees) for degrees in range(-180, 180, 15))):
            if _free_ahead(world, turned) >= ROOM_AHEAD:
                return replace(world, start=(x, y, round(turned, 2)))


def _free_ahead(world: World, yaw: float) -> float:
    """What is free at the robot's start, m, if it looks to there."""
    distances = Lidar(world.lidar, world.segments(), world.discs()).distances(*world.start[:2], yaw)
    return float(np.min(np.roll(distances, BESIDE)[: 2 * BESIDE + 1]))


def _walled(
    name: str, seed: int, bounds: Rectangle, start: tuple[float, float, float], picture: str
) -> World:
    """A rectangle with walls all round."""
    left, low, right, top = bounds
    corners = [(left, low), (right, low), (right, top), (left, top), (left, low)]
    return World(
        name=f"{name}_{seed}",
        card=f"Picture: {picture}",
        bounds=bounds,
        start=start,
        walls=tuple(itertools.pairwise(corners)),
    )
