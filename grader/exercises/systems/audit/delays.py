"""Delays of a system's messages and responses: an order in which they arrive."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from grader.exercises.systems.audit.six_systems import SYSTEMS
from grader.geometry.near import is_near

TICK, STEP, LONGEST = 0.01, 5, 30  # s; ticks between two delays that differ, and of the longest one
ENTRIES = 20  # of a list that are read

Delays = Mapping[str, list[int]]
"""For each topic and service, the delays of its messages or responses, in ticks; the last is for the rest."""


def read_delays(name: str, given: Any) -> dict[str, list[int]]:
    """Return the delays that a student gives for a system, in ticks.

    given: for a topic or a service, the seconds by which each of its messages or responses is late, or a list
    with a number for each. Raises ValueError if a system can't have these delays.
    """
    names = SYSTEMS[name].delayed
    if not isinstance(given, Mapping) or not given:
        raise ValueError(f"{str(given)[:60]}, which isn't a dictionary with a topic or a service in it")
    found: dict[str, list[int]] = {}
    for key, value in given.items():
        key_name = str(key).removeprefix("/")
        if key_name not in names:
            raise ValueError(f"a delay of “{str(key)[:40]}”, which isn't one of {', '.join(names)}")
        several = isinstance(value, list | tuple)
        found[key_name] = [*map(_ticks, value[:ENTRIES]), 0] if several else [_ticks(value)]
    return found


def _ticks(seconds: Any) -> int:
    """Return a delay in ticks. Raises ValueError for one that can't be."""
    number = isinstance(seconds, int | float) and not isinstance(seconds, bool)
    ticks = round(seconds / TICK) if number and 0.0 <= seconds <= 1.0 else -1
    if not 0 <= ticks <= LONGEST or ticks % STEP or not is_near(seconds, ticks * TICK, 1e-6):
        steps = f"0, {STEP * TICK:g}, ... {LONGEST * TICK:g} s"
        raise ValueError(f"a delay of {str(seconds)[:20]} s, which isn't one of {steps}")
    return ticks


def delay_of(delays: Delays, name: str, number: int) -> int:
    """Return by how many ticks message or response `number` of a topic or service is late, from 0 on."""
    values = delays.get(name) or [0]
    return values[min(number, len(values) - 1)]
