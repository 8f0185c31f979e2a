"""Fields and halls drawn from a seed: a leader to follow, a tower that watches a scout, a wall ahead."""

import math
import random

from grader.worlds.walled import walled
from sim.world import Box, LidarModel, OtherRobot, World

FIELD = (-4.0, -3.0, 4.0, 3.0)  # m
BEHIND = 1.6  # m from the leader at the start


def convoy(seed: int) -> World:
    """Return a field with a block, round which a leader drives; the robot begins behind it, and aside."""
    draw = random.Random(f"convoy {seed}")
    side, speed = draw.choice((-1.0, 1.0)), round(draw.uniform(0.18, 0.22), 3)
    y, x = -1.8 * side, -1.2
    leader = OtherRobot("leader", (x, y, 0.0), ((-2.6, y), (2.6, y), (2.6, -y), (-2.6, -y)), speed)
    start = x - BEHIND, round(y + draw.uniform(-0.3, 0.3), 2), round(draw.uniform(-0.5, 0.5), 2)
    picture, block = "A leader drives round a block.", (Box(0.0, 0.0, 0.0, 3.0, 1.6),)
    return walled("convoy", seed, FIELD, picture, start=start, boxes=block, robots=(leader,))


def parked(seed: int) -> World:
    """Return a field in which the leader is parked ahead of the robot, turned to anywhere ahead."""
    draw = random.Random(f"parked {seed}")
    leader = OtherRobot("leader", (0.6, round(draw.uniform(-0.5, 0.5), 2), round(draw.uniform(-0.9, 0.9), 2)))
    start = -2.4, round(draw.uniform(-0.5, 0.5), 2), 0.0
    return walled("parked", seed, FIELD, "A leader is parked in a field.", start=start, robots=(leader,))


def square(seed: int) -> World:
    """Return a field with a scout that drives round a square, a tower in its middle, and another robot."""
    draw = random.Random(f"square {seed}")
    half = round(draw.uniform(1.4, 1.8), 2)
    route = (-half, -half), (half, -half), (half, half), (-half, half)
    scout = OtherRobot("scout", (*route[0], 0.0), route, 0.25)
    tower = OtherRobot("tower", (0.0, 0.0, round(draw.uniform(-math.pi, math.pi), 2)))
    robots = scout, tower
    return walled("square", seed, FIELD, "A scout drives round a tower.", start=(-3.4, 2.4, 0.0),
                  robots=robots)


def ramp(seed: int) -> World:
    """Return a hall with a wall straight ahead, 2.2 m to 3 m away: the lidar sees it, noise and all."""
    bounds = -1.5, -1.0, round(random.Random(f"ramp {seed}").uniform(2.2, 3.0), 2), 1.0
    return walled("ramp", seed, bounds, "A hall that goes up towards the wall ahead.",
                  lidar=LidarModel(noise=0.03))
