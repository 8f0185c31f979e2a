"""Reads and checks a world file (TOML); each fault is one sentence that names file, key and cure."""

from __future__ import annotations

import itertools
import tomllib
from collections.abc import Collection, Iterator
from dataclasses import MISSING, asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from sim.suggestions import closest_match
from sim.world.machines import KINDS, kind_of
from sim.world.model import Model, ModelError, UnfitError, WorldError, fit, hints, nested, shown, words
from sim.world.obstacles import Point, Segment

if TYPE_CHECKING:
    from sim.world.description import World

CARD_HEADINGS = ("Picture", "Topics", "Frames and units", "Start", "Ends when")
"""The headings of every world's card, in their order."""

CORNERS = "two or more corners [x, y] (metres), each different from the one before"

# A world file holds the fields of `World`, but for its name; at most one of these becomes `World.machine`.
MACHINES: dict[str, type[Model]] = {kind.key: kind.model for kind in KINDS}

_CARD = f"a [card] table with a text for each of {', '.join(CARD_HEADINGS)}"
_M = TypeVar("_M", bound=Model)


def read(path: Path, world: type[World]) -> World:
    """Return the world that a file describes.

    Raises:
        WorldError: the file cannot be read, is not TOML, or holds a wrong key or value.
    """
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise WorldError(f"Cannot read {path} ({error.strerror}); check the path.") from error
    except UnicodeDecodeError as error:
        raise WorldError(f"{path.name} is not UTF-8 text; save it as UTF-8.") from error
    except tomllib.TOMLDecodeError as error:
        raise WorldError(f"{path.name} is not valid TOML ({error}); correct it there.") from error
    except (ValueError, RecursionError) as error:  # a number of 5000 digits, a list in a thousand lists
        raise WorldError(f"{path.name} is not a world file ({error}); correct it there.") from error
    if "card" not in data:
        raise WorldError(f"{path.name}: card is missing; write {_CARD}.")
    try:
        return _world(world, data, name=path.stem, card=_card(data["card"]))
    except WorldError as fault:
        raise WorldError(f"{path.name}: {fault}") from fault


def to_data(world: World) -> dict[str, Any]:
    """A world as plain data: the keys and values of its file, with name and card as texts."""
    data = {key: value for key, value in asdict(world).items() if value is not None}
    if world.machine is not None:
        data[kind_of(world.machine).key] = data.pop("machine")
    return data


def from_data(data: Any, world: type[World]) -> World:
    """The world of which `to_data` made this.

    Raises:
        WorldError: the data holds a wrong key or value.
    """
    if not isinstance(data, dict):
        raise WorldError(f"the world is {shown(data)}; write a table of its keys and values.")
    rest = {key: value for key, value in data.items() if key != "name"}
    try:
        return _world(world, rest, name=data.get("name"), card=data.get("card"))
    except WorldError as fault:
        raise WorldError(f"the world: {fault}") from fault


def _world(world: type[World], data: dict[str, Any], **named: Any) -> World:
    """The world that this data describes, of this name and with this card."""
    keys = [key for key in hints(world) if key not in ("name", "card", "machine")]
    _check_known("", data, [*keys, *MACHINES, "card"])
    machines = [key for key in MACHINES if key in data]
    if len(machines) > 1:
        raise WorldError(f"{' and '.join(machines)} are both here; keep one of them.")
    _check_there("", data, world, ("bounds",) if machines else ("bounds", "start"))
    values = {key: data[key] for key in keys if key in data} | named
    if "walls" in data:
        values["walls"] = tuple(_segments(data["walls"], words(world, "walls")))
    for key in machines:
        values["machine"] = _table(key, data[key], MACHINES[key])
    return _made("", values, world)


def _made(place: str, values: dict[str, Any], model: type[_M]) -> _M:
    """A model with these values, in which tables stand for inner models."""
    read = {}
    for key, value in values.items():
        inner, many = nested(model, key)
        read[key] = value if inner is None else (_tables if many else _table)(place + key, value, inner)
    try:
        return model(**read)
    except ModelError as error:
        raise WorldError(place + error.fault) from error


def _tables(place: str, tables: Any, model: type[_M]) -> tuple[_M, ...]:
    if not isinstance(tables, list | tuple) or not all(isinstance(table, dict) for table in tables):
        *keys, last = hints(model)
        raise _wrong(place, tables, f"a [[{place}]] table for each, with {', '.join(keys)} and {last}")
    return tuple(_table(f"{place}[{index}]", table, model) for index, table in enumerate(tables))


def _table(place: str, table: Any, model: type[_M]) -> _M:
    if not isinstance(table, dict):
        raise _wrong(place, table, f"a [{place}] table with any of {', '.join(hints(model))}")
    _check_known(f"{place}.", table, hints(model))
    needed = [item.name for item in fields(model) if item.default is item.default_factory is MISSING]
    _check_there(f"{place}.", table, model, needed)
    return _made(f"{place}.", table, model)


def _segments(walls: Any, wanted: str) -> Iterator[Segment]:
    if not isinstance(walls, list | tuple):
        raise _wrong("walls", walls, wanted)
    for index, wall in enumerate(walls):
        try:
            corners = fit(tuple[Point, ...], wall)
        except UnfitError:
            corners = ()
        if len(corners) < 2 or any(a == b for a, b in itertools.pairwise(corners)):
            raise _wrong(f"walls[{index}]", wall, CORNERS)
        yield from itertools.pairwise(corners)


def _card(card: Any) -> str:
    if not isinstance(card, dict):
        raise _wrong("card", card, _CARD)
    _check_known("card.", card, CARD_HEADINGS)
    for heading in CARD_HEADINGS:
        if heading not in card:
            raise WorldError(f"card.{heading} is missing; write a short text.")
        if not isinstance(card[heading], str) or not card[heading].strip():
            raise _wrong(f"card.{heading}", card[heading], "a short text")
    return "\n".join(f"{heading}: {' '.join(card[heading].split())}" for heading in CARD_HEADINGS)


def _check_known(place: str, table: dict[str, Any], known: Collection[str]) -> None:
    for key in table:
        if key not in known:
            near = closest_match(key, known)
            cure = f"did you mean {near}?" if near else f"the keys are {', '.join(known)}."
            raise WorldError(f"{place}{key} is not a known key; {cure}")


def _check_there(place: str, table: dict[str, Any], model: type[Model], needed: Collection[str]) -> None:
    for key in needed:
        if key not in table:
            raise WorldError(f"{place}{key} is missing; write {words(model, key)}.")


def _wrong(place: str, value: object, wanted: str) -> WorldError:
    return WorldError(f"{place} is {shown(value)}; write {wanted}.")
