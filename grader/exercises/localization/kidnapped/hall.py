"""A hall that looks the same from both ends, except for what is near them, and a robot's trip."""

import functools
import math
import random
from dataclasses import replace
from typing import NamedTuple

from grader.geometry import Pose2D
from grader.worlds.slippery import slippery
from grader.worlds.walled import walled
from sim.evidence import Seconds
from sim.world import Box, Circle, LidarModel, World

CARRIED: tuple[Seconds, Seconds] = (19.0, 22.0)  # between these, someone carries the robot away
# m. Slightly below whole cells with the margin of a map, which so is the same after half a turn, too.
HALF_LENGTH, HALF_WIDTH = 6.505 - 1e-9, 1.305 - 1e-9
RANGE = 2.3  # m, of the lidar
ALIKE = 2.4  # m from the middle: up to there, no scan shows what is different at the ends
COLUMNS, BOX = 5.05, 5.6  # m from the middle, at its two ends: neither fits a map of the other
TURNAROUND = 4.7, 3.7  # m from the middle: between these the robot drives to and fro, once it is at an end
PARKED = 0.05  # m, rad: so far off is what is known about the start
SLIP = 0.005  # m: standard deviation of a wheel's distance after 1 m


class Trip(NamedTuple):
    """A robot's start, the pose at which it is put down (x, y, yaw), and its routes from there (x, y).

    middle: the point (x, y) around which the hall looks the same after half a turn. parked: about where the
    start is (x, y, yaw). carried: when the robot is put down.
    """

    middle: tuple[float, float]
    start: tuple[float, float, float]
    put_down: tuple[float, float, float]
    first: tuple[tuple[float, float], ...]
    then: tuple[tuple[float, float], ...]
    parked: tuple[float, float, float]
    carried: Seconds


def twin(pose: Pose2D, middle: tuple[float, float]) -> Pose2D:
    """Return the pose from which the hall looks the same: half a turn around its middle."""
    yaw = math.remainder(pose.yaw + math.pi, math.tau)
    return Pose2D(2 * middle[0] - pose.x, 2 * middle[1] - pose.y, yaw)


def _leg(draw: random.Random, middle: tuple[float, float]) -> tuple[tuple[float, float, float], list[float]]:
    """A pose in the part that looks the same, and the x coordinates of the corners of a route from there."""
    side = draw.choice((-1.0, 1.0))
    x, y = middle[0] + side * draw.uniform(1.5, 2.0), middle[1] + draw.uniform(-0.3, 0.3)
    yaw = draw.choice((0.0, math.pi)) + draw.uniform(-0.5, 0.5)
    far, near = (middle[0] - side * turn for turn in TURNAROUND)
    return (round(x, 2), round(y, 2), round(math.remainder(yaw, math.tau), 2)), [far, near] * 20


@functools.lru_cache(maxsize=64)
def trip(seed: int) -> Trip:
    """Return the trip of a seed."""
    draw = random.Random(f"trip {seed}")
    middle = round(draw.uniform(-4, 4), 2), round(draw.uniform(-4, 4), 2)
    (start, first), (put_down, then) = _leg(draw, middle), _leg(draw, middle)
    lanes = [tuple((x, middle[1]) for x in one) for one in (first, then)]
    x, y, yaw = (round(value + draw.uniform(-PARKED, PARKED), 3) for value in start)
    return Trip(middle, start, put_down, lanes[0], lanes[1], (x, y, yaw), round(draw.uniform(*CARRIED), 1))


@functools.lru_cache(maxsize=64)
def hall(seed: int) -> World:
    """Return the hall of a seed; the robot is at the start of its trip, its odometry begins anywhere."""
    draw, one = random.Random(f"hall {seed}"), trip(seed)
    boxes, circles = _furniture(draw)
    cx, cy = one.middle
    bounds = cx - HALF_LENGTH, cy - HALF_WIDTH, cx + HALF_LENGTH, cy + HALF_WIDTH
    lidar = LidarModel(rays=360, noise=0.02, dropouts=0.03, range_max=RANGE)
    empty = walled("hall", seed, bounds, "A long hall that looks the same from both ends.", start=one.start)
    x, y, yaw = (round(draw.uniform(low, high), 2) for low, high in ((-4, 4), (-4, 4), (-3, 3)))
    return replace(
        slippery(empty, slip=SLIP, left=draw.choice((0.99, 1.01))), lidar=lidar,
        boxes=tuple(replace(box, x=box.x + cx, y=box.y + cy) for box in boxes),
        circles=tuple(replace(circle, x=circle.x + cx, y=circle.y + cy) for circle in circles),
        robot=replace(empty.robot, odometry=(x, y, yaw)),
    )


@functools.lru_cache(maxsize=64)
def carried_hall(seed: int) -> World:
    """Return the same hall, in which someone carries the robot away."""
    world, one = hall(seed), trip(seed)
    return replace(world, robot=replace(world.robot, carried=((one.carried, *one.put_down),)))


def _furniture(draw: random.Random) -> tuple[list[Box], list[Circle]]:
    """Things around (0, 0): pairs that half a turn exchanges; a box at one end, two columns at the other."""
    boxes, circles = [], []
    for number, (low, high) in enumerate(((0.5, 1.1), (1.9, 2.5), (3.3, 3.9))):
        x, side = draw.uniform(low, high), draw.choice((-1.0, 1.0))
        if number == 1:
            y, radius = side * draw.uniform(0.85, 0.95), draw.uniform(0.1, 0.15)
            circles += [Circle(x, y, radius), Circle(-x, -y, radius)]
        else:
            wide, deep = draw.uniform(0.3, 0.7), draw.uniform(0.25, 0.45)
            y = side * (HALF_WIDTH - deep / 2)
            boxes += [Box(x, y, 0.0, wide, deep), Box(-x, -y, 0.0, wide, deep)]
    boxes.append(Box(BOX, 0.0, 0.0, 0.5, 1.0))
    circles += [Circle(-COLUMNS, y, 0.3) for y in (-0.85, 0.85)]
    return boxes, circles
