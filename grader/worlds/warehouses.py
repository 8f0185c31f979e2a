"""Warehouses in which something happens to the robot, each drawn from a seed."""

import dataclasses
import functools
import itertools
import math
import random

import numpy as np

from grader.geometry.ground import drivable, shortest
from grader.geometry.pose import Point
from sim.world import MovableBox, World
from sim.world.clearance import clearance

NEVER = 10_000.0  # s; an order in such an interval is the only one of a run
TIRED = 0.2  # of the battery's capacity
EVERY, PATIENCE = 15.0, 75.0  # s; of many orders; carrying one out takes 25 to 60
PATIENT = 300.0  # s; of one order alone: a robot that waits for people may take 250
BOX, MASS, ROOM = 0.8, 50.0, 0.3  # m and kg of what is in the way; m that are free beside another way
FAIR = {  # seeds in which the solution and three other good robots miss nothing, by `tests.exercises.fair`
    "shift": (10, 12, 13, 14, 15, 16, 18, 20, 22, 23, 31, 34, 35, 36, 37, 39, 40, 41, 45, 49, 50, 53),
    "blind": (10, 11, 12, 13, 15, 18, 19, 20, 22, 24, 25, 26, 27, 28, 30, 31, 32, 33, 34, 35),
    "blocked": (10, 11, 12, 13, 14, 16, 17, 18, 19, 22, 23, 24, 25, 27, 28, 30, 31, 33, 34, 36, 37, 38),
    "canceled": (10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31),
    "restarted": (10, 11, 12, 13, 14, 15, 17, 18, 20, 22, 23, 24, 25, 26, 27, 28, 30, 31, 32),
}
"""A shift is graded in the usual order, the others in any: where people walk, some seeds ask too much."""
APART = 1.0  # m from its middle to where a robot or a person begins, and to where things are fetched


@functools.lru_cache(maxsize=32)
def warehouse(kind: str, seed: int) -> World:
    """Return the warehouse of a scenario.

    shift: many orders, and a tired battery. blind: one order, and a lidar that stops publishing at times.
    blocked: one order, and a box that is on no map stands on the way. canceled: the first order is canceled
    before the second one comes. restarted: one order.
    """
    world = World.generate("warehouse", seed=seed)
    if kind == "shift":
        world = _with(world, "battery", start=TIRED)
        return _with(world, "warehouse", interval=EVERY, patience=PATIENCE, canceled=0.0)
    world = _with(world, "battery", start=1.0)
    world = _with(world, "warehouse", interval=NEVER, patience=PATIENT, canceled=0.0)
    if kind == "blind":
        return _with(world, "lidar", silent=silences(seed))
    if kind == "blocked":
        return _blocked(world, seed)
    if kind == "canceled":
        return _with(world, "warehouse", interval=12.0, withdrawn=(7.5,))
    return world


@functools.lru_cache(maxsize=16)
def floor_of(seed: int) -> World:
    """Return a small warehouse with a person in it, and boxes."""
    return World.generate("warehouse", seed=seed, columns=2, rows=2, movable=2, people=1)


def hall(seed: int) -> World:
    """Return a warehouse as it is generated."""
    return World.generate("warehouse", seed=seed)


def silences(seed: int) -> tuple[tuple[float, float], ...]:
    """Return when the lidar of the blind robot stops publishing, and when it resumes, s."""
    draw = random.Random(f"silences {seed}").uniform
    spans = [(draw(9.0, 13.0), draw(4.0, 5.0)) for _ in range(3)]
    times = list(itertools.accumulate(itertools.chain.from_iterable(spans), initial=2.0))[1:]
    return tuple((round(begin, 1), round(end, 1)) for begin, end in zip(times[::2], times[1::2], strict=True))


def _with(world: World, part: str, **figures: object) -> World:
    """The world with other figures in one of its parts."""
    return dataclasses.replace(world, **{part: dataclasses.replace(getattr(world, part), **figures)})


def _blocked(world: World, seed: int) -> World:
    """One place where goods are fetched, and a box on the way there, so that another way is left."""
    chance, kept = random.Random(f"box {seed}"), [world.start, *(person.route[0] for person in world.people)]
    pickups = world.warehouse.pickups if world.warehouse else ()
    for place in chance.sample(pickups, len(pickups)):
        known = dataclasses.replace(_with(world, "warehouse", pickups=(place,)), goal=place[:2])
        solid = dataclasses.replace(known, movable=(), boxes=(*world.boxes, *world.movable))
        way = drivable(solid)
        for part in (0.5, 0.35, 0.65):
            spot = _middle(solid, way[int(part * len(way))])
            box = MovableBox(*spot, 0.0, BOX, BOX, MASS)
            fits = min(math.dist(spot, other[:2]) for other in (*kept, place)) > APART
            closed = dataclasses.replace(solid, boxes=(*solid.boxes, box))
            if fits and _room(solid, *spot) > BOX / 2 and shortest(closed, ROOM) < math.inf:
                return dataclasses.replace(known, movable=(*world.movable, box), goal=None)
    raise ValueError(f"seed {seed}: no way could be blocked so that another one is left")


def _middle(world: World, spot: Point) -> Point:
    """Return where there is most room, in the neighbourhood of a point."""
    steps = [0.1 * step for step in range(-6, 7)]
    around = np.array([(spot[0] + right, spot[1] + up) for right in steps for up in steps])
    x, y = around[clearance(world, *around.T).argmax()].tolist()
    return round(x, 2), round(y, 2)


def _room(world: World, x: float, y: float) -> float:
    """Return how far it is from a point to what is solid, m."""
    return float(clearance(world, np.array([x]), np.array([y]))[0])
