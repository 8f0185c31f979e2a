"""Worlds of 09_frames, drawn from a seed."""

from __future__ import annotations

import itertools
import math
import random

from sim import World
from sim.world import Box, OtherRobot

BEHIND = 1.6  # m from the leader at the start


def convoy(seed: int) -> World:
    """A field with a block, round which a leader drives; the robot begins behind it, and a little aside."""
    draw = random.Random(f"convoy {seed}")
    side, speed = draw.choice((-1.0, 1.0)), round(draw.uniform(0.18, 0.22), 3)
    route = [(-2.6, -1.8 * side), (2.6, -1.8 * side), (2.6, 1.8 * side), (-2.6, 1.8 * side)]
    leader = OtherRobot("leader", (-1.2, -1.8 * side, 0.0), tuple(route), speed)
    start = (
        -1.2 - BEHIND,
        round(-1.8 * side + draw.uniform(-0.3, 0.3), 2),
        round(draw.uniform(-0.5, 0.5), 2),
    )
    block = (Box(0.0, 0.0, 0.0, 3.0, 1.6),)
    return _field("convoy", seed, start, (leader,), "A leader drives round a block.", block)


def parked(seed: int) -> World:
    """A field in which the leader stands, somewhere ahead of the robot and turned to anywhere ahead."""
    draw = random.Random(f"parked {seed}")
    leader = OtherRobot("leader", (0.6, round(draw.uniform(-0.5, 0.5), 2), round(draw.uniform(-0.9, 0.9), 2)))
    start = (-2.4, round(draw.uniform(-0.5, 0.5), 2), 0.0)
    return _field("parked", seed, start, (leader,), "A leader stands in a field.")


def square(seed: int) -> World:
    """Three robots: a scout that drives round a square, a tower in its middle, and another one."""
    draw = random.Random(f"square {seed}")
    half = round(draw.uniform(1.4, 1.8), 2)
    route = ((-half, -half), (half, -half), (half, half), (-half, half))
    scout = OtherRobot("scout", (-half, -half, 0.0), route, 0.25)
    tower = OtherRobot("tower", (0.0, 0.0, round(draw.uniform(-math.pi, math.pi), 2)))
    return _field("square", seed, (-3.4, 2.4, 0.0), (scout, tower), "A scout drives round a tower.")


def _field(
    name: str,
    seed: int,
    start: tuple[float, float, float],
    robots: tuple[OtherRobot, ...],
    picture: str,
    boxes: tuple[Box, ...] = (),
) -> World:
    """A walled field of 8 m by 6 m."""
    corners = [(-4.0, -3.0), (4.0, -3.0), (4.0, 3.0), (-4.0, 3.0), (-4.0, -3.0)]
    return World(
        name=f"{name}_{seed}",
        card=f"Picture: {picture}",
        bounds=(-4.0, -3.0, 4.0, 3.0),
        start=start,
        walls=tuple(itertools.pairwise(corners)),
        boxes=boxes,
        robots=robots,
    )
