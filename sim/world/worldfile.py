"""Reads and checks a world file (TOML); each fault is one sentence that names file, key and cure."""

from __future__ import annotations

import difflib
import itertools
import tomllib
from collections.abc import Collection, Iterator
from dataclasses import MISSING, asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from sim.world.imu import ImuModel
from sim.world.lidar import LidarModel
from sim.world.machines import ArmModel, CartPoleModel, JointModel
from sim.world.model import Model, ModelError, UnfitError, WorldError, fit, hints, shown, words
from sim.world.obstacles import Box, Circle, MovableBox, Point, Segment
from sim.world.robot import OtherRobot, RobotModel

if TYPE_CHECKING:
    from sim.world.description import World

CARD_HEADINGS = ("Picture", "Topics", "Frames and units", "Start", "Ends when")
"""The headings of every world's card, in their order."""

CORNERS = "two or more corners [x, y] (metres), each different from the one before"

# The tables of a world file and what each is read into.
TABLES: dict[str, type[Model]] = {"robot": RobotModel, "lidar": LidarModel, "imu": ImuModel}
LISTS: dict[str, type[Model]] = {
    "boxes": Box,
    "circles": Circle,
    "movable": MovableBox,
    "robots": OtherRobot,
}
# At most one of these; it becomes `World.machine`.
MACHINES: dict[str, type[Model]] = {"joint": JointModel, "arm": ArmModel, "cart_pole": CartPoleModel}

_KEYS = ("bounds", "start", "goal", "walls", *LISTS, *TABLES, *MACHINES, "card")
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
    return _Reader(path.name).world(data, world, path.stem)


def to_data(world: World) -> dict[str, Any]:
    """A world as plain data: the keys and values of its file, with name and card as texts."""
    data = {key: value for key, value in asdict(world).items() if value is not None}
    if world.machine is not None:
        kind = next(key for key, model in MACHINES.items() if type(world.machine) is model)
        data[kind] = data.pop("machine")
    return data


def from_data(data: Any, world: type[World]) -> World:
    """The world of which `to_data` made this.

    Raises:
        WorldError: the data holds a wrong key or value.
    """
    reader = _Reader("the world")
    if not isinstance(data, dict):
        raise WorldError(f"the world is {shown(data)}; write a table of its keys and values.")
    rest = {key: value for key, value in data.items() if key not in ("name", "card")}
    named = {key: data.get(key) for key in ("name", "card")}
    return reader.make("", world, named | reader.fields(rest, world))


class _Reader:
    """Turns parsed TOML into a world; knows the file's name for the error sentences."""

    def __init__(self, file: str) -> None:
        self._file = file

    def world(self, data: dict[str, Any], world: type[World], name: str) -> World:
        if "card" not in data:
            raise WorldError(f"{self._file}: card is missing; write {_CARD}.")
        fields = self.fields(data, world)
        return self.make("", world, fields | {"name": name, "card": self._card(data["card"])})

    def fields(self, data: dict[str, Any], world: type[World]) -> dict[str, Any]:
        """All that is in the data, but the card."""
        self._check_known("", data, _KEYS)
        machines = [key for key in MACHINES if key in data]
        if len(machines) > 1:
            raise WorldError(f"{self._file}: {' and '.join(machines)} are both here; keep one of them.")
        self._check_there("", data, world, ("bounds",) if machines else ("bounds", "start"))
        read: dict[str, Any] = {key: data[key] for key in ("bounds", "start", "goal") if key in data}
        if "walls" in data:
            read["walls"] = tuple(self._walls(data["walls"], words(world, "walls")))
        read |= {key: self._list(key, data[key], model) for key, model in LISTS.items() if key in data}
        read |= {key: self._table(key, data[key], model) for key, model in TABLES.items() if key in data}
        for key in machines:
            read["machine"] = self._table(key, data[key], MACHINES[key])
        return read

    def make(self, place: str, model: type[_M], values: dict[str, Any]) -> _M:
        """A model with these values."""
        try:
            return model(**values)
        except ModelError as error:
            raise WorldError(f"{self._file}: {place}{error.fault}") from error

    def _walls(self, walls: object, wanted: str) -> Iterator[Segment]:
        if not isinstance(walls, list | tuple):
            raise self._wrong("walls", walls, wanted)
        for index, wall in enumerate(walls):
            try:
                corners = fit(tuple[Point, ...], wall)
            except UnfitError:
                corners = ()
            if len(corners) < 2 or any(a == b for a, b in itertools.pairwise(corners)):
                raise self._wrong(f"walls[{index}]", wall, CORNERS)
            yield from itertools.pairwise(corners)

    def _list(self, key: str, tables: object, model: type[_M]) -> tuple[_M, ...]:
        if not isinstance(tables, list | tuple) or not all(isinstance(table, dict) for table in tables):
            keys = _keys(model)
            needed = f"{', '.join(keys[:-1])} and {keys[-1]}"
            raise self._wrong(key, tables, f"a [[{key}]] table for each, with {needed}")
        return tuple(self._table(f"{key}[{index}]", table, model) for index, table in enumerate(tables))

    def _table(self, key: str, table: object, model: type[_M]) -> _M:
        keys = _keys(model)
        if not isinstance(table, dict):
            raise self._wrong(key, table, f"a [{key}] table with any of {', '.join(keys)}")
        place = f"{key}."
        self._check_known(place, table, keys)
        self._check_there(place, table, model, _required(model))
        inner = {name: hint for name, hint in hints(model).items() if _is_model(hint) and name in table}
        tables = {name: self._table(place + name, table[name], hint) for name, hint in inner.items()}
        return self.make(place, model, table | tables)

    def _card(self, card: object) -> str:
        if not isinstance(card, dict):
            raise self._wrong("card", card, _CARD)
        self._check_known("card.", card, CARD_HEADINGS)
        for heading in CARD_HEADINGS:
            if heading not in card:
                raise WorldError(f"{self._file}: card.{heading} is missing; write a short text.")
            text = card[heading]
            if not isinstance(text, str) or not text.strip():
                raise self._wrong(f"card.{heading}", text, "a short text")
        return "\n".join(f"{heading}: {' '.join(card[heading].split())}" for heading in CARD_HEADINGS)

    def _check_known(self, place: str, table: dict[str, Any], known: Collection[str]) -> None:
        for key in table:
            if key not in known:
                close = difflib.get_close_matches(key, known, n=1)
                cure = f"did you mean {close[0]}?" if close else f"the keys are {', '.join(known)}."
                raise WorldError(f"{self._file}: {place}{key} is not a known key; {cure}")

    def _check_there(
        self, place: str, table: dict[str, Any], model: type[Model], needed: Collection[str]
    ) -> None:
        for key in needed:
            if key not in table:
                raise WorldError(f"{self._file}: {place}{key} is missing; write {words(model, key)}.")

    def _wrong(self, place: str, value: object, wanted: str) -> WorldError:
        return WorldError(f"{self._file}: {place} is {shown(value)}; write {wanted}.")


def _is_model(hint: object) -> bool:
    return isinstance(hint, type) and issubclass(hint, Model)


def _keys(model: type[Model]) -> list[str]:
    return [field.name for field in fields(model)]


def _required(model: type[Model]) -> list[str]:
    return [field.name for field in fields(model) if field.default is field.default_factory is MISSING]
