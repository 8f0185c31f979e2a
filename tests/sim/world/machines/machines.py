"""Worlds for machines, and a way to step through them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from sim.world import World, simulate


def alone(model: Any, seed: int = 0, start: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Any:
    """The simulation of one machine in an empty world."""
    return simulate(World("test", "", (-3.0, -3.0, 3.0, 3.0), start, machine=model), seed)


def steps(machine: Any, seconds: float) -> Iterator[float]:
    """Advance step by step for so long; yields the time (s) after each."""
    first = round(machine.time * 100)
    for step in range(first + 1, first + round(seconds * 100) + 1):
        machine.advance(step / 100)
        yield machine.time
