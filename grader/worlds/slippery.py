"""Worlds whose robot has bad wheels, or is carried away."""

from dataclasses import replace

from sim.evidence import Seconds
from sim.world import WheelModel, World

SLIP = 0.007  # m: standard deviation of a wheel's distance after 1 m


def slippery_floor() -> World:
    """Return an empty yard in which a robot's wheels slip as in the drives of an exercise."""
    return replace(World.load("yard"), wheels=WheelModel(slip=SLIP))


def slippery(world: World, slip: float = 0.01, left: float = 0.98) -> World:
    """Return the world with wheels that slip; the left one is smaller than the robot believes."""
    return replace(world, wheels=WheelModel(slip=slip, left_scale=left))


def carried(world: World, time: Seconds, x: float, y: float, yaw: float) -> World:
    """Return the world, in which someone carries the robot to a pose on the map at that time."""
    return replace(world, robot=replace(world.robot, carried=((time, x, y, yaw),)))
