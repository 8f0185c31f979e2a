"""Rooms, halls and mazes, drawn from a seed; one with a box in the way that is in no map."""

import functools
import math
import random
from dataclasses import replace

import numpy as np

from grader.geometry.ground import drivable, shortest
from grader.worlds.walled import walled
from sim.world import Box, Circle, LidarModel, World
from sim.world.lidar import Lidar

MARGIN = 0.5
"""How far (m) from the wall a wall follower starts, and should stay."""

FREE_AHEAD, BESIDE = 1.5, 60  # meters that are free at the start, within so many degrees of straight ahead
BLOCK = 0.8  # meters; the side of the box in the way
CHEAP = LidarModel(noise=0.03, dropouts=0.05)
SHORT = LidarModel(range_max=1.8)  # of a hall: at the start no ray hits anything
TOO_CLOSE, AT_THE_WALL = LidarModel(range_min=0.25), 0.2  # m from the wall, where rays to it are -inf
GAP = 0.15  # meters; how far from everything there is still a path past the box


def hall(seed: int) -> World:
    """Return a wide hall: the wall ahead of the robot is 3 m to 5 m away, those beside it 2 m."""
    ahead = random.Random(f"hall {seed}").uniform(3.0, 5.0)
    return walled("hall", seed, (-2.5, -2.0, round(ahead, 2), 2.0), "An empty hall.", start=(0.0, 0.0, 0.0))


def short_sighted(world: World) -> World:
    """Return the world with a lidar that sees nothing beyond 1.8 m: most of its rays are inf."""
    return replace(world, lidar=SHORT)


def past_a_post(seed: int) -> World:
    """Return a hall of 4 m with a post beside the robot's way: too far aside to be hit."""
    draw = random.Random(f"past_a_post {seed}")
    x, y = draw.uniform(1.6, 2.0), draw.choice((-1.0, 1.0)) * draw.uniform(0.6, 0.8)
    card, post = "A hall with a post.", Circle(round(x, 2), round(y, 2), 0.1)
    return walled("past_a_post", seed, (-2.5, -2.0, 4.0, 2.0), card, start=(0.0, 0.0, 0.0), circles=(post,))


def long_hall(seed: int) -> World:
    """Return a hall of 18 m, for long drives straight ahead."""
    left = round(-1.0 - random.Random(f"long_hall {seed}").uniform(0.0, 0.5), 2)
    card = "A hall of 18 m, without anything in it."
    return walled("long_hall", seed, (left, -1.5, 17.0, 1.5), card, start=(0.0, 0.0, 0.0))


def gallery(seed: int) -> World:
    """Return a room with a pillar in its middle. The robot starts with the lower wall on its right."""
    draw = random.Random(f"gallery {seed}")
    width, height = round(draw.uniform(3.6, 5.0), 2), round(draw.uniform(3.2, 4.2), 2)
    start = (round(draw.uniform(0.9, width - 1.9), 2), MARGIN, 0.0)
    card, pillar = "A room with a round pillar in its middle.", Circle(width / 2, height / 2, 0.3)
    return walled("gallery", seed, (0.0, 0.0, width, height), card, start=start, circles=(pillar,))


def gallery_from_the_wall(seed: int) -> World:
    """Return a gallery in which the robot starts closer to the wall than its lidar can measure."""
    world = gallery(seed)
    x, _, yaw = world.start
    return replace(world, start=(x, AT_THE_WALL, yaw), lidar=TOO_CLOSE)


def screened(seed: int) -> World:
    """Return a room with a screen before the goal. The end that is nearer to the goal is the longer way."""
    draw = random.Random(f"screened {seed}")
    near, far, aside, ahead, behind = (
        round(draw.uniform(*limits), 2)
        for limits in ((1.1, 1.3), (1.45, 1.65), (1.6, 1.9), (3.3, 3.6), (0.6, 0.9))
    )
    side = draw.choice((-1.0, 1.0))
    screen = Box(ahead, 2.5 + side * (far - near) / 2, 0.0, 0.1, far + near)
    start, goal = (0.6, 2.5 + side * aside, 0.0), (ahead + behind, 2.5)
    card = "A room with a screen."
    return walled("screened", seed, (0.0, 0.0, 5.0, 5.0), card, start=start, goal=goal, boxes=(screen,))


def furnished_room(seed: int) -> World:
    """Return a room with boxes and pillars."""
    return World.generate("room", seed=seed, boxes=3, circles=2)


def free_start(seed: int) -> World:
    """Return a furnished room in which 1.5 m ahead of the robot are free, so that a driver can begin."""
    chance = random.Random(f"free_start {seed}")
    drawn = seed
    while True:
        world = furnished_room(drawn)
        x, y, yaw = world.start
        for turned in (yaw, *(math.radians(degrees) for degrees in range(-180, 180, 15))):
            if _free_ahead(world, turned) >= FREE_AHEAD:
                return replace(world, start=(x, y, round(turned, 2)))
        drawn = chance.randrange(2**31)


@functools.lru_cache(maxsize=64)
def world_of(kind: str, seed: int) -> World:
    """Return a room, a field of clutter or a maze, with start and goal. The maze is of 5 by 5 cells.

    kind: room, clutter, maze; noisy: a room whose lidar is as bad as a cheap one; screened.
    """
    if kind == "screened":
        return screened(seed)
    if kind == "maze":
        return World.generate("maze", seed=seed, columns=5, rows=5, loops=0.1)
    if kind == "noisy":
        return replace(World.generate("room", seed=seed), lidar=CHEAP, name=f"noisy_{seed}")
    return World.generate(kind, seed=seed)


@functools.lru_cache(maxsize=64)
def blocked(seed: int) -> tuple[World, World]:
    """Return a room with a box in the way, and the same room as the map shows it: without the box.

    The robot's lidar is mounted a little off its middle, and turned.
    """
    draw = random.Random(f"lidar {seed}")
    turn = draw.choice((-1.0, 1.0)) * round(draw.uniform(1.2, math.pi), 2)
    lidar = replace(CHEAP, x=round(draw.uniform(-0.06, 0.06), 2), y=0.05, yaw=turn)
    for attempt in range(100):
        known = World.generate("room", seed=(seed + attempt * 7919) % 2**32, boxes=3)
        known = replace(known, name=f"blocked_{seed}")
        path = drivable(known)
        box = Box(*path[len(path) // 2], known.start[2], BLOCK, BLOCK)
        real = replace(known, boxes=(*known.boxes, box), lidar=lidar)
        if shortest(real, GAP) < 1.5 * shortest(known, GAP):
            return real, known
    raise ValueError(f"seed {seed}: no room could be blocked so that a way is left")


@functools.lru_cache(maxsize=64)
def yard_from(seed: int) -> World:
    """Return the yard, for a robot that starts where its odometry says. With seed 1, at 0."""
    yard, draw = World.load("yard"), random.Random(f"yard {seed}")
    x, y, yaw = (round(draw.uniform(low, high), 2) for low, high in ((-2.5, 2.0), (-2.5, 2.0), (-3.0, 3.0)))
    start = (0.0, 0.0, 0.0) if seed == 1 else (x, y, yaw)
    return replace(yard, start=start, robot=replace(yard.robot, odometry=start))


def _free_ahead(world: World, yaw: float) -> float:
    """The distance (m) that is free ahead of the robot at its start, were it turned like this."""
    distances = Lidar(world.lidar, world.segments(), world.discs()).distances(*world.start[:2], yaw)
    return float(np.min(np.roll(distances, BESIDE)[: 2 * BESIDE + 1]))
