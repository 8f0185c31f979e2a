"""Thirteen functions that say how fast a robot may drive, three right ones and ten wrong ones.

What they have to do is the contract in the assignment; which is which, the seed says.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable

WRONG = 10
FASTEST, GAP = 0.5, 0.2  # m/s, m
Speed = Callable[[float, float], float]


def _allowed(
    gap: float = GAP, fastest: float = FASTEST, back: float = FASTEST, brakes: float = 1.0, part: float = 1.0
) -> Speed:
    """The contract, or what another figure makes of it."""

    def speed(distance: float, wish: float) -> float:
        if math.isnan(distance) or math.isnan(wish):
            return 0.0
        if wish < 0:
            return max(wish, -back)
        return min(wish, fastest, part * math.sqrt(brakes * max(0.0, distance - gap)))

    return speed


_right = _allowed()


def _in_steps(distance: float, wish: float) -> float:
    """Right, too: reckoned another way, so the last digits differ."""
    if not (distance == distance and wish == wish):
        return 0.0
    if wish <= 0.0:
        return -min(-wish, FASTEST)
    room = (distance - GAP) if distance > GAP else 0.0
    return min(wish, FASTEST, math.exp(0.5 * math.log(room)) if room > 0.0 else 0.0)


def _rounded(distance: float, wish: float) -> float:
    """Right, too: to a micrometre a second."""
    return round(_right(distance, wish), 6)


def _unless(where: Callable[[float, float], bool], otherwise: Speed) -> Speed:
    """The contract, save at some places."""
    return lambda distance, wish: (
        otherwise(distance, wish) if where(distance, wish) else _right(distance, wish)
    )


def candidates(seed: int) -> list[tuple[bool, Speed]]:
    """All of them in the order of a seed, and whether each is right."""
    chance = random.Random(f"candidates {seed}")
    made = [(True, one) for one in (_right, _in_steps, _rounded)]
    made += [(False, one) for one in _wrong_ones(chance)]
    chance.shuffle(made)
    return made


def _wrong_ones(chance: random.Random) -> list[Speed]:
    """Ten functions with a defect each, of a size that chance gives."""
    draw = chance.uniform
    near = draw(0.06, 0.12)
    drawn = [
        _allowed(gap=draw(0.0, 0.08)),
        _allowed(fastest=draw(0.7, 2.0)),
        _allowed(back=draw(0.8, 2.0)),
        _allowed(back=0.0),
        _allowed(brakes=draw(1.6, 3.0)),
        _allowed(part=draw(0.4, 0.7)),
        _allowed(gap=draw(0.4, 0.6)),
        _unless(lambda distance, wish: wish >= 0, lambda distance, wish: _right(distance, 9.0)),
        _unless(lambda distance, wish: math.isnan(distance), lambda distance, wish: _right(9.0, wish)),
        _unless(lambda distance, wish: math.isinf(distance), lambda distance, wish: 0.0),
        _unless(lambda distance, wish: distance < near, lambda distance, wish: _right(9.0, wish)),
        _unless(lambda distance, wish: math.isnan(wish), lambda distance, wish: FASTEST),
        lambda distance, wish: 0.0,
    ]
    return chance.sample(drawn, WRONG)
