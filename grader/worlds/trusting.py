"""Robots that trust their last command: silence doesn't stop them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from sim.world import World

FOREVER = 1000.0  # s; longer than any run


def trusting(world: str | World | Callable[[int], World]) -> Callable[[int], World]:
    """Return a world for a scenario in which the robot obeys its last command until the next one arrives.

    world: a world or its name, or a function of the seed that draws one.
    """

    def drawn(seed: int) -> World:
        made = world(seed) if callable(world) else World.load(world) if isinstance(world, str) else world
        return replace(made, robot=replace(made.robot, command_timeout=FOREVER))

    return drawn
