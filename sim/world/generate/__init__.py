"""Worlds from a seed: each leaves a way from start to goal, or to all places of a warehouse.

The way is for a robot of the usual size, with room to spare.

Only `Random.random`, whose numbers Python promises to keep, and arithmetic that rounds alike everywhere: so
equal seeds give equal worlds on all machines.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from numbers import Integral
from random import Random
from typing import Any

from sim.suggestions import closest_match
from sim.world.generate.floor import Clutter, FullError, Room
from sim.world.generate.maze import Maze
from sim.world.generate.warehouse import Warehouse
from sim.world.model import ModelError, WorldError, shown

KINDS: dict[str, type[Maze | Room | Clutter | Warehouse]] = {
    "room": Room,
    "maze": Maze,
    "clutter": Clutter,
    "warehouse": Warehouse,
}
_TRIES = 20  # whole worlds drawn before one is called too full


def generate(kind: str, seed: int, figures: dict[str, Any]) -> dict[str, Any]:
    """The fields of the world of this kind and seed.

    Raises:
        WorldError: there is no such kind or figure, a figure cannot be, or the obstacles do not fit.
    """
    if kind not in KINDS:
        raise WorldError(f"There is no kind of world {kind!r} to generate. {_guess(kind, KINDS)}")
    if not isinstance(seed, Integral) or isinstance(seed, bool) or seed < 0:
        raise WorldError(f"The seed of a world is {shown(seed)}; write a whole number, 0 or more.")
    known = [field.name for field in fields(KINDS[kind])]
    for name in figures:
        if name not in known:
            raise WorldError(f"A generated {kind} has no {name!r}. {_guess(name, known)}")
    try:
        plan = KINDS[kind](**figures)
    except ModelError as error:
        raise WorldError(f"A generated {kind} cannot be: {error.fault}") from error
    for attempt in range(_TRIES):
        try:
            return plan.draw(Random(f"{kind} {seed} {attempt}")) | {"name": f"{kind}_{seed}"}
        except FullError:
            continue
    raise WorldError(
        f"A {kind} of {plan.width:g} m by {plan.height:g} m is too small for all this; "
        "make it larger, or ask for fewer obstacles."
    )


def _guess(name: str, known: Iterable[str]) -> str:
    near = closest_match(str(name), known)
    return f"Did you mean {near!r}?" if near else f"There are {', '.join(known)}."
