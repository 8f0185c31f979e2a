"""A warehouse in which a person comes into the view of a robot that stays where it is."""

import functools
import math
import random
from dataclasses import replace

import numpy as np

from grader.geometry import Point
from grader.geometry.near import is_near
from sim.world import LidarModel, World
from sim.world.clearance import clearance
from sim.world.route import Route

FAR, CLOSE = 3.0, 0.7  # m; what is judged is nearer than the one, and boxes farther than the other
COMES = 7.5, 11.0  # s; when the person comes into view
LATE = 0.3  # s from a scan to its message: the robot has turned in between
MEETS = 15.5  # s; by then this person has come to the robot


@functools.lru_cache(maxsize=16)
def crossing(seed: int) -> World:
    """Return a warehouse in which a person will walk to the robot.

    A box is in view; the lidar is off the robot's middle, and its scans come late.
    """
    draw = random.Random(f"crossing {seed}")
    side, turn = draw.choice((-1.0, 1.0)), draw.uniform(0.5, math.pi)
    lidar = LidarModel(x=0.07, y=0.04 * side, yaw=round(side * turn, 2), latency=LATE)
    for attempt in range(400):
        world = World.generate("warehouse", seed=(seed + attempt * 7919) % 2**32, movable=6)
        person = world.people[0]
        route = Route(person.route)
        place = person.speed * draw.uniform(9.0, MEETS)
        x, y = (round(value, 2) for value in route.point(place))
        if place < route.length - 2.0 and _is_good(world, (x, y), route):
            start = (x, y, round(draw.uniform(-3.0, 3.0), 2))
            return replace(world, name=f"warehouse_{seed}", start=start, lidar=lidar)
    raise ValueError(f"seed {seed}: no warehouse has such a place")


def _is_good(world: World, here: Point, route: Route) -> bool:
    """Return whether a box is in view from here, and the person comes into view in time."""
    boxes = [(box.x, box.y) for box in world.movable]
    if not any(not is_near(here, box, CLOSE) and in_view(world, here, box, FAR - 0.5) for box in boxes):
        return False
    speed = world.people[0].speed
    times = np.arange(0.0, COMES[1], 0.25)
    seen = [when for when in times if in_view(world, here, route.point(speed * when), FAR + 1.0, 0.0)]
    return bool(seen and seen[0] > COMES[0])


def in_view(world: World, here: Point, there: Point, reach: float, gap: float = 0.25) -> bool:
    """Return whether a place is at most `reach` (m) away, with nothing of the map near that line.

    gap: how far (m) all of the map must be from the line.
    """
    if not is_near(here, there, reach):
        return False
    x, y = (np.linspace(a, b, 40) for a, b in zip(here, there, strict=True))
    return bool((clearance(world, x, y)[:-4] > gap).all())
