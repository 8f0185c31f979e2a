"""Thirteen functions that return how fast a robot may drive, three right ones and ten wrong ones.

The contract is in the assignment; the seed decides which is which.
"""

import math
import random
from collections.abc import Callable

from grader.exercises.safety.mutants.bench import Speed

WRONG = 10
FASTEST, GAP = 0.5, 0.2  # m/s, m


def _allowed(gap: float = GAP, fastest: float = FASTEST, back: float = FASTEST, brakes: float = 1.0,
             part: float = 1.0) -> Speed:
    """Return a function that keeps the contract, or one with another figure in it."""

    def speed(distance: float, requested: float) -> float:
        if math.isnan(distance) or math.isnan(requested):
            return 0.0
        if requested < 0:
            return max(requested, -back)
        return min(requested, fastest, part * math.sqrt(brakes * max(0.0, distance - gap)))

    return speed


_right = _allowed()


def _in_steps(distance: float, requested: float) -> float:
    """Right, too: computed another way, so the last digits differ."""
    if not (distance == distance and requested == requested):
        return 0.0
    if requested <= 0.0:
        return -min(-requested, FASTEST)
    room = (distance - GAP) if distance > GAP else 0.0
    return min(requested, FASTEST, math.exp(0.5 * math.log(room)) if room > 0.0 else 0.0)


def _rounded(distance: float, requested: float) -> float:
    """Right, too: to a micrometre a second."""
    return round(_right(distance, requested), 6)


def _unless(where: Callable[[float, float], bool], otherwise: Speed) -> Speed:
    """Return the contract with an exception at some places."""
    return lambda distance, requested: (
        otherwise(distance, requested) if where(distance, requested) else _right(distance, requested)
    )


def candidates(seed: int) -> list[tuple[bool, Speed]]:
    """Return all of them in the order of a seed, each with whether it is right."""
    rng = random.Random(f"candidates {seed}")
    made = [(True, one) for one in (_right, _in_steps, _rounded)]
    made += [(False, one) for one in _wrong_ones(rng)]
    rng.shuffle(made)
    return made


def _wrong_ones(rng: random.Random) -> list[Speed]:
    """Return ten functions with a defect each, of a random size."""
    draw = rng.uniform
    near = draw(0.06, 0.12)
    drawn = [
        _allowed(gap=draw(0.0, 0.08)),
        _allowed(fastest=draw(0.7, 2.0)),
        _allowed(back=draw(0.8, 2.0)),
        _allowed(back=0.0),
        _allowed(brakes=draw(1.6, 3.0)),
        _allowed(part=draw(0.4, 0.7)),
        _allowed(gap=draw(0.4, 0.6)),
        _unless(
            lambda distance, requested: requested >= 0, lambda distance, requested: _right(distance, 9.0)
        ),
        _unless(
            lambda distance, requested: math.isnan(distance),
            lambda distance, requested: _right(9.0, requested),
        ),
        _unless(lambda distance, requested: math.isinf(distance), lambda distance, requested: 0.0),
        _unless(
            lambda distance, requested: distance < near, lambda distance, requested: _right(9.0, requested)
        ),
        _unless(lambda distance, requested: math.isnan(requested), lambda distance, requested: FASTEST),
        lambda distance, requested: 0.0,
    ]
    return rng.sample(drawn, WRONG)
