"""Worlds with a joint or an arm, drawn from a seed: other limits, other speeds, other lengths."""

import functools
import random
from dataclasses import replace

from sim.world import World
from sim.world.machines import ArmModel, JointModel

NOISE = 0.001  # rad, rad/s; of the encoders
EDGE = 0.06
"""How far (m) the table's edge is from the arm's shoulder, on the side where the figure isn't."""


def _between(draw: random.Random, low: float, high: float) -> float:
    return round(draw.uniform(low, high), 2)


@functools.lru_cache(maxsize=64)
def joint_of(seed: int) -> World:
    """Return the world joint with a motor that may be slow or quick, limits of its own, a noisy encoder."""
    draw = random.Random(f"joint {seed}")
    model = JointModel(
        lower=-_between(draw, 1.2, 2.0), upper=_between(draw, 1.2, 2.0),
        max_velocity=draw.choice((0.4, 0.5, 0.6, 0.7)), max_acceleration=3.0,
        position_noise=NOISE, velocity_noise=NOISE,
    )
    return replace(World.load("joint"), machine=model, name=f"joint_{seed}")


@functools.lru_cache(maxsize=64)
def arm_of(seed: int) -> World:
    """Return the world arm with limits of its own, no two alike, and noisy encoders.

    Its driver may name the elbow first.
    """
    draw, noise = random.Random(f"arm {seed}"), (NOISE, NOISE)
    shoulder = JointModel(-_between(draw, 1.0, 1.4), _between(draw, 1.6, 2.0), 0.0, 1.5, 4.0, 0.5, *noise)
    elbow = JointModel(-_between(draw, 2.0, 2.4), _between(draw, 0.7, 0.9), 0.0, 2.0, 6.0, 0.4, *noise)
    model = ArmModel(shoulder, elbow, elbow_first=draw.random() < 0.7 or seed == 1)
    return replace(World.load("arm"), machine=model, name=f"arm_{seed}")


@functools.lru_cache(maxsize=64)
def desk_of(seed: int) -> World:
    """Return the world arm with links of other lengths and a table's edge beside it, on either side."""
    draw = random.Random(f"desk {seed}")
    shoulder = JointModel(-2.6, 2.6, 0.0, 1.5, 4.0, _between(draw, 0.45, 0.6))
    elbow = JointModel(-2.6, 2.6, 0.0, 2.0, 6.0, _between(draw, 0.38, 0.44))
    y = -side_of(seed) * EDGE
    model = ArmModel(shoulder, elbow, elbow_first=draw.random() < 0.5)
    return replace(World.load("arm"), machine=model, walls=(((-1.1, y), (1.1, y)),), name=f"desk_{seed}")


def side_of(seed: int) -> int:
    """Return on which side of the x axis the figure is: 1 to the left, -1 to the right."""
    return random.Random(f"side {seed}").choice((1, -1)) if seed > 2 else (1, -1)[seed % 2]
