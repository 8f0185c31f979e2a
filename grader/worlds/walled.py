"""A world with walls all round, for those that are drawn from a seed."""

from typing import Any

from grader.geometry import rectangle
from sim.world import World


def walled(name: str, seed: int, bounds: tuple[float, float, float, float], picture: str,
           **figures: Any) -> World:
    """Return a world with walls along its bounds (left, bottom, right, top; m).

    picture: its card's first line. figures: further fields of `World`, such as `start`.
    """
    card = f"Picture: {picture}"
    return World(name=f"{name}_{seed}", card=card, bounds=bounds, walls=rectangle(*bounds), **figures)
