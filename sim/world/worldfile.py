"""Reads and checks a world file (TOML); each fault is one sentence that names file, key and cure."""

import difflib
import itertools
import sys
import tomllib
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from sim.world.obstacles import Box, Circle, Segment

CARD_HEADINGS = ("Picture", "Topics", "Frames and units", "Start", "Ends when")
"""The headings of every world's card, in their order."""

# What may stand in a world file, in the words that tell its author how to write it.
_CORNERS = "two or more corners [x, y] (metres), each different from the one before"
_KEYS = {
    "bounds": "[xmin, ymin, xmax, ymax] (metres) with xmin < xmax and ymin < ymax",
    "start": "[x, y, yaw] (metres and radians) inside the bounds",
    "goal": "[x, y] (metres) inside the bounds",
    "walls": f"a list of walls, each a list of {_CORNERS}",
    "boxes": "a [[boxes]] table for each box, with x, y, yaw, width and height",
    "circles": "a [[circles]] table for each circle, with x, y and radius",
    "card": f"a [card] table with a text for each of {', '.join(CARD_HEADINGS)}",
}
_REQUIRED = ("bounds", "start", "card")
_NUMBER = "a finite number"
_SIZE = "a finite number above 0 (metres)"
_BOX_KEYS = {"x": _NUMBER, "y": _NUMBER, "yaw": _NUMBER, "width": _SIZE, "height": _SIZE}
_CIRCLE_KEYS = {"x": _NUMBER, "y": _NUMBER, "radius": _SIZE}
_CARD_KEYS = dict.fromkeys(CARD_HEADINGS, "a short text")


class WorldError(ValueError):
    """A world cannot be found, read or used."""


def read(path: Path) -> dict[str, Any]:
    """Return the fields of the `World` that the file describes, all but its name.

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
    """Turns parsed TOML into checked fields; knows the file's name for the error sentences."""

    def __init__(self, file: str) -> None:
        self._file = file

    def fields(self, data: dict[str, Any]) -> dict[str, Any]:
        self._check_keys("", data, _KEYS, _REQUIRED)
        bounds = self._bounds(data["bounds"])
        boxes = self._tables("boxes", data.get("boxes", []), _BOX_KEYS)
        circles = self._tables("circles", data.get("circles", []), _CIRCLE_KEYS)
        return {
            "bounds": bounds,
            "start": self._place("start", data["start"], 3, bounds),
            "goal": self._place("goal", data["goal"], 2, bounds) if "goal" in data else None,
            "walls": tuple(self._walls(data.get("walls", []))),
            "boxes": tuple(Box(**box) for box in boxes),
            "circles": tuple(Circle(**circle) for circle in circles),
            "card": self._card(data["card"]),
        }

    def _bounds(self, value: object) -> tuple[float, ...]:
        if not _are_numbers(value, 4) or value[0] >= value[2] or value[1] >= value[3]:
            raise self._wrong("bounds", value, _KEYS["bounds"])
        return tuple(map(float, value))

    def _place(self, key: str, value: object, count: int, bounds: tuple[float, ...]) -> tuple[float, ...]:
        xmin, ymin, xmax, ymax = bounds
        if not _are_numbers(value, count) or not (xmin <= value[0] <= xmax and ymin <= value[1] <= ymax):
            raise self._wrong(key, value, _KEYS[key])
        return tuple(map(float, value))

    def _walls(self, walls: object) -> Iterator[Segment]:
        if not isinstance(walls, list):
            raise self._wrong("walls", walls, _KEYS["walls"])
        for index, wall in enumerate(walls):
            if not _are_corners(wall):
                raise self._wrong(f"walls[{index}]", wall, _CORNERS)
            yield from itertools.pairwise((float(x), float(y)) for x, y in wall)

    def _tables(self, key: str, tables: object, wanted: dict[str, str]) -> Iterator[dict[str, float]]:
        if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
            raise self._wrong(key, tables, _KEYS[key])
        for index, table in enumerate(tables):
            place = f"{key}[{index}]."
            self._check_keys(place, table, wanted, wanted)
            for name, value in table.items():
                if not _is_number(value) or (wanted[name] is _SIZE and value <= 0):
                    raise self._wrong(place + name, value, wanted[name])
            yield {name: float(value) for name, value in table.items()}

    def _card(self, card: object) -> str:
        if not isinstance(card, dict):
            raise self._wrong("card", card, _KEYS["card"])
        self._check_keys("card.", card, _CARD_KEYS, _CARD_KEYS)
        for heading, text in card.items():
            if not isinstance(text, str) or not text.strip():
                raise self._wrong(f"card.{heading}", text, _CARD_KEYS[heading])
        return "\n".join(f"{heading}: {' '.join(card[heading].split())}" for heading in CARD_HEADINGS)

    def _check_keys(
        self, place: str, table: dict[str, Any], wanted: dict[str, str], required: Collection[str]
    ) -> None:
        for key in table:
            if key not in wanted:
                close = difflib.get_close_matches(key, wanted, n=1)
                cure = f"did you mean {close[0]}?" if close else f"the keys are {', '.join(wanted)}."
                raise WorldError(f"{self._file}: {place}{key} is not a known key; {cure}")
        for key in required:
            if key not in table:
                raise WorldError(f"{self._file}: {place}{key} is missing; write {wanted[key]}.")

    def _wrong(self, place: str, value: object, wanted: str) -> WorldError:
        return WorldError(f"{self._file}: {place} is {value!r}; write {wanted}.")


def _is_number(value: object) -> bool:
    # Not math.isfinite: TOML allows whole numbers too big for it.
    return type(value) in (int, float) and abs(value) <= sys.float_info.max


def _are_numbers(value: object, count: int) -> bool:
    return isinstance(value, list) and len(value) == count and all(map(_is_number, value))


def _are_corners(wall: object) -> bool:
    return (
        isinstance(wall, list)
        and len(wall) >= 2
        and all(_are_numbers(corner, 2) for corner in wall)
        and all(a != b for a, b in itertools.pairwise(wall))
    )
