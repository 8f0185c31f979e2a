"""Reads and validates a world file (TOML); each error is one sentence that names file, key and remedy."""

from __future__ import annotations

import itertools
import tomllib
from collections.abc import Collection, Iterator
from dataclasses import MISSING, asdict, fields
from pathlib import Path
from typing import Any, TypeVar

from sim.suggestions import closest_match
from sim.world.machines import KINDS, kind_of
from sim.world.obstacles import Point, Segment
from sim.world.validated_model import (
    InvalidValueError,
    Model,
    ModelError,
    WorldError,
    convert,
    field_types,
    format_value,
    nested_model,
    phrase,
)

CARD_HEADINGS = ("Picture", "Topics", "Frames and units", "Start", "Ends when")
"""The headings of every world's card, in order."""

CORNERS = "two or more corners [x, y] (meters), each different from the one before"

# A world file has the fields of `World` except its name; at most one of these tables becomes `World.machine`.
MACHINES: dict[str, type[Model]] = {kind.key: kind.model for kind in KINDS}

_CARD = f"a [card] table with a text for each of {', '.join(CARD_HEADINGS)}"
_M = TypeVar("_M", bound=Model)
_WorldT = TypeVar("_WorldT", bound=Model)  # `World`, which imports this module


def read(path: Path, world: type[_WorldT]) -> _WorldT:
    """Return the world that a file describes.

    Raises:
        WorldError: the file cannot be read, is not TOML, or has an invalid key or value.
    """
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise WorldError(f"Cannot read {path} ({error.strerror}); check the path.") from error
    except UnicodeDecodeError as error:
        raise WorldError(f"{path.name} is not UTF-8 text; save it as UTF-8.") from error
    except tomllib.TOMLDecodeError as error:
        raise WorldError(f"{path.name} is not valid TOML ({error}); correct it there.") from error
    except (ValueError, RecursionError) as error:  # a number of 5000 digits, a list nested a thousand deep
        raise WorldError(f"{path.name} is not a world file ({error}); correct it there.") from error
    if "card" not in data:
        raise WorldError(f"{path.name}: card is missing; write {_CARD}.")
    try:
        return _world(world, data, name=path.stem, card=_card(data["card"]))
    except WorldError as error:
        raise WorldError(f"{path.name}: {error}") from error


def to_data(world: Model, machine: Model | None) -> dict[str, Any]:
    """A world and its machine as plain data: the keys and values of its file, with name and card as texts."""
    data = {key: value for key, value in asdict(world).items() if value is not None}
    if machine is not None:
        data[kind_of(machine).key] = data.pop("machine")
    return data


def from_data(data: Any, world: type[_WorldT]) -> _WorldT:
    """The world that `to_data` converted to this data.

    Raises:
        WorldError: the data has an invalid key or value.
    """
    if not isinstance(data, dict):
        raise WorldError(f"the world is {format_value(data)}; write a table of its keys and values.")
    rest = {key: value for key, value in data.items() if key != "name"}
    try:
        return _world(world, rest, name=data.get("name"), card=data.get("card"))
    except WorldError as error:
        raise WorldError(f"the world: {error}") from error


def _world(world: type[_WorldT], data: dict[str, Any], **named: Any) -> _WorldT:
    """The world of this data, name and card."""
    keys = [key for key in field_types(world) if key not in ("name", "card", "machine")]
    _check_known("", data, [*keys, *MACHINES, "card"])
    machines = [key for key in MACHINES if key in data]
    if len(machines) > 1:
        raise WorldError(f"{' and '.join(machines)} are both here; keep one of them.")
    _check_required("", data, world, ("bounds",) if machines else ("bounds", "start"))
    values = {key: data[key] for key in keys if key in data} | named
    if "walls" in data:
        values["walls"] = tuple(_segments(data["walls"], phrase(world, "walls")))
    for key in machines:
        values["machine"] = _table(key, data[key], MACHINES[key])
    return _model("", values, world)


def _model(prefix: str, values: dict[str, Any], model: type[_M]) -> _M:
    """A model with these values; values of nested models are tables."""
    converted = {}
    for key, value in values.items():
        inner, many = nested_model(model, key)
        converted[key] = value if inner is None else (_tables if many else _table)(prefix + key, value, inner)
    try:
        return model(**converted)
    except ModelError as error:
        raise WorldError(prefix + error.reason) from error


def _tables(key: str, tables: Any, model: type[_M]) -> tuple[_M, ...]:
    if not isinstance(tables, list | tuple) or not all(isinstance(table, dict) for table in tables):
        *names, last = field_types(model)
        raise _invalid(key, tables, f"a [[{key}]] table for each, with {', '.join(names)} and {last}")
    return tuple(_table(f"{key}[{index}]", table, model) for index, table in enumerate(tables))


def _table(key: str, table: Any, model: type[_M]) -> _M:
    if not isinstance(table, dict):
        raise _invalid(key, table, f"a [{key}] table with any of {', '.join(field_types(model))}")
    _check_known(f"{key}.", table, field_types(model))
    required = [item.name for item in fields(model) if item.default is item.default_factory is MISSING]
    _check_required(f"{key}.", table, model, required)
    return _model(f"{key}.", table, model)


def _segments(walls: Any, wanted: str) -> Iterator[Segment]:
    if not isinstance(walls, list | tuple):
        raise _invalid("walls", walls, wanted)
    for index, wall in enumerate(walls):
        try:
            corners = convert(tuple[Point, ...], wall)
        except InvalidValueError:
            corners = ()
        if len(corners) < 2 or any(a == b for a, b in itertools.pairwise(corners)):
            raise _invalid(f"walls[{index}]", wall, CORNERS)
        yield from itertools.pairwise(corners)


def _card(card: Any) -> str:
    if not isinstance(card, dict):
        raise _invalid("card", card, _CARD)
    _check_known("card.", card, CARD_HEADINGS)
    for heading in CARD_HEADINGS:
        if heading not in card:
            raise WorldError(f"card.{heading} is missing; write a short text.")
        if not isinstance(card[heading], str) or not card[heading].strip():
            raise _invalid(f"card.{heading}", card[heading], "a short text")
    return "\n".join(f"{heading}: {' '.join(card[heading].split())}" for heading in CARD_HEADINGS)


def _check_known(prefix: str, table: dict[str, Any], known: Collection[str]) -> None:
    for key in table:
        if key not in known:
            near = closest_match(key, known)
            remedy = f"did you mean {near}?" if near else f"the keys are {', '.join(known)}."
            raise WorldError(f"{prefix}{key} is not a known key; {remedy}")


def _check_required(
    prefix: str, table: dict[str, Any], model: type[Model], required: Collection[str]
) -> None:
    for key in required:
        if key not in table:
            raise WorldError(f"{prefix}{key} is missing; write {phrase(model, key)}.")


def _invalid(key: str, value: object, wanted: str) -> WorldError:
    return WorldError(f"{key} is {format_value(value)}; write {wanted}.")
