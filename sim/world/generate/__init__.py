"""Generates random worlds from a seed, each with a free path from start to goal or to all shelves.

The path is free for a robot of the default size, with a margin.

Generators use only `Random.random`, whose sequence Python guarantees, and arithmetic that rounds equally on
all
platforms: so equal seeds give equal worlds everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from numbers import Integral
from random import Random
from typing import Any

from sim.suggestions import closest_match
from sim.world.generate.maze import Maze
from sim.world.generate.room import Clutter, NoSpaceError, Room
from sim.world.generate.warehouse_layout import Warehouse
from sim.world.validated_model import ModelError, WorldError, format_value

KINDS: dict[str, type[Maze | Room | Clutter | Warehouse]] = {
    "room": Room,
    "maze": Maze,
    "clutter": Clutter,
    "warehouse": Warehouse,
}
_ATTEMPTS = 20  # worlds drawn before the parameters are rejected


def generate(kind: str, seed: int, parameters: dict[str, Any]) -> dict[str, Any]:
    """The fields of the world of this kind and seed.

    Raises:
        WorldError: an unknown kind or parameter, an invalid value, or obstacles that do not fit.
    """
    if kind not in KINDS:
        raise WorldError(f"There is no kind of world {kind!r} to generate. {_suggestion(kind, KINDS)}")
    if not isinstance(seed, Integral) or isinstance(seed, bool) or seed < 0:
        raise WorldError(f"The seed of a world is {format_value(seed)}; write a whole number, 0 or more.")
    known = [field.name for field in fields(KINDS[kind])]
    for name in parameters:
        if name not in known:
            raise WorldError(f"A generated {kind} has no {name!r}. {_suggestion(name, known)}")
    try:
        generator = KINDS[kind](**parameters)
    except ModelError as error:
        raise WorldError(f"A generated {kind} like that is not possible: {error.reason}") from error
    for attempt in range(_ATTEMPTS):
        try:
            return generator.draw(Random(f"{kind} {seed} {attempt}")) | {"name": f"{kind}_{seed}"}
        except NoSpaceError:
            continue
    raise WorldError(
        f"A {kind} of {generator.width:g} m by {generator.height:g} m is too small for all this; "
        "make it larger, or ask for fewer obstacles."
    )


def _suggestion(name: str, known: Iterable[str]) -> str:
    near = closest_match(str(name), known)
    return f"Did you mean {near!r}?" if near else f"There are {', '.join(known)}."
