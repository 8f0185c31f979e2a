"""Reads and checks a world file (TOML); every fault is one sentence that names the file, the key and the cure."""

import difflib
import itertools
import math
import tomllib
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from sim.world.obstacles import Box, Circle, Segment

CARD_HEADINGS = ("Picture", "Topics", "Frames and units", "Start", "Ends when")

# What a world file may hold, in the words that tell a reader how to write it.
_KEYS = {
    "bounds": "[xmin, ymin, xmax, ymax] (metres) with xmin < xmax and ymin < ymax",
    "start": "[x, y, yaw] (metres and radians) inside the bounds",
    "goal": "[x, y] (metres) inside the bounds",
    "walls": "a list of walls, each a list of two or more corners [x, y] (metres), no corner equal to the one before",
    "boxes": "[[boxes]] tables with x, y, yaw, width and height",
    "circles": "[[circles]] tables with x, y and radius",
    "card": f"a [card] table with a text for each of {', '.join(CARD_HEADINGS)}",
}
_REQUIRED = ("bounds", "start", "card")
_NUMBER = "a finite number"
_SIZE = "a finite number above 0 (metres)"


class WorldError(ValueError):
    """A world cannot be found, read or used."""


def read(path: Path) -> dict[str, Any]:
    """Return the fields of the `World` that the file describes.

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
    return _Checker(path.name).fields(data)


class _Checker:
    """Turns parsed TOML into checked world fields; knows the file's name for its error sentences."""

    def __init__(self, file: str) -> None:
        self._file = file

    def fields(self, data: dict[str, Any]) -> dict[str, Any]:
        self._keys("", data, _REQUIRED, _KEYS, _KEYS)
        bounds = self._bounds(data["bounds"])
        return {
            "bounds": bounds,
            "start": self._place("start", data["start"], 3, bounds),
            "goal": self._place("goal", data["goal"], 2, bounds) if "goal" in data else None,
            "walls": tuple(self._walls(data.get("walls", []))),
            "boxes": self._tables("boxes", data, Box, sizes=("width", "height")),
            "circles": self._tables("circles", data, Circle, sizes=("radius",)),
            "card": self._card(data["card"]),
        }

    def _bounds(self, value: object) -> tuple[float, ...]:
        if not _numbers(value, 4) or value[0] >= value[2] or value[1] >= value[3]:
            raise self._wrong("bounds", value, _KEYS["bounds"])
        return tuple(map(float, value))

    def _place(self, key: str, value: object, count: int, bounds: tuple[float, ...]) -> tuple[float, ...]:
        xmin, ymin, xmax, ymax = bounds
        if not _numbers(value, count) or not (xmin <= value[0] <= xmax and ymin <= value[1] <= ymax):
            raise self._wrong(key, value, _KEYS[key])
        return tuple(map(float, value))

    def _walls(self, walls: object) -> Iterable[Segment]:
        if not isinstance(walls, list):
            raise self._wrong("walls", walls, _KEYS["walls"])
        for index, wall in enumerate(walls):
            whole = isinstance(wall, list) and len(wall) >= 2 and all(_numbers(corner, 2) for corner in wall)
            if not whole or any(a == b for a, b in itertools.pairwise(wall)):
                raise self._wrong(f"walls[{index}]", wall, "two or more different corners [x, y] (metres)")
            yield from itertools.pairwise((float(x), float(y)) for x, y in wall)

    def _tables(self, key: str, data: dict[str, Any], kind: Callable, sizes: tuple[str, ...]) -> tuple:
        tables = data.get(key, [])
        if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
            raise self._wrong(key, tables, _KEYS[key])
        return tuple(self._obstacle(f"{key}[{index}].", table, kind, sizes) for index, table in enumerate(tables))

    def _obstacle(self, place: str, table: dict[str, Any], kind: Callable, sizes: tuple[str, ...]) -> tuple:
        names = kind._fields
        self._keys(place, table, names, names, {name: _SIZE if name in sizes else _NUMBER for name in names})
        for name in names:
            value = table[name]
            if not _number(value) or (name in sizes and value <= 0):
                raise self._wrong(place + name, value, _SIZE if name in sizes else _NUMBER)
        return kind(**{name: float(table[name]) for name in names})

    def _card(self, card: object) -> str:
        if not isinstance(card, dict):
            raise self._wrong("card", card, _KEYS["card"])
        self._keys("card.", card, CARD_HEADINGS, CARD_HEADINGS, dict.fromkeys(CARD_HEADINGS, "a short text"))
        for heading in CARD_HEADINGS:
            if not isinstance(card[heading], str) or not card[heading].strip():
                raise self._wrong(f"card.{heading}", card[heading], "a short text")
        return "\n".join(f"{heading}: {' '.join(card[heading].split())}" for heading in CARD_HEADINGS)

    def _keys(
        self, place: str, table: dict[str, Any], required: Iterable[str], known: Iterable[str], help: dict[str, str]
    ) -> None:
        for key in table:
            if key not in known:
                close = difflib.get_close_matches(key, known, n=1)
                cure = f"did you mean {close[0]}?" if close else f"the keys are {', '.join(known)}."
                raise WorldError(f"{self._file}: {place}{key} is not a known key; {cure}")
        for key in required:
            if key not in table:
                raise WorldError(f"{self._file}: {place}{key} is missing; write {help[key]}.")

    def _wrong(self, place: str, value: object, wanted: str) -> WorldError:
        return WorldError(f"{self._file}: {place} is {value!r}; write {wanted}.")


def _number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _numbers(value: object, count: int) -> bool:
    return isinstance(value, list) and len(value) == count and all(map(_number, value))
