"""Fields of messages, requests and the like: told in words, and compared with what they should be."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from typing import Any

LONGEST = 120  # characters of a message in words


def told(message: Any) -> str:
    """A message in words: "a=2, b=3"; cut where it gets long."""
    names = message.get_fields_and_field_types()
    text = ", ".join(f"{name}={_plain(getattr(message, name))!r}" for name in names)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def wanted(values: Mapping[str, Any]) -> str:
    """Values in words, as `told` has them."""
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def differing(message: Any, values: Mapping[str, Any]) -> list[str]:
    """The fields of a message that don't have these values; names may have dots, such as "pose.position.x".

    Numbers with a point may differ by a millionth.
    """
    return [name for name, value in values.items() if not _alike(read(message, name), value)]


def read(message: Any, name: str) -> Any:
    """A field's value; a sequence comes as a list."""
    return _plain(functools.reduce(getattr, name.split("."), message))


def _plain(value: Any) -> Any:
    return value.tolist() if hasattr(value, "tolist") else value


def _alike(value: Any, expected: Any) -> bool:
    if isinstance(value, float) and isinstance(expected, int | float):
        return math.isclose(value, expected, rel_tol=1e-6, abs_tol=1e-6)
    if isinstance(value, list | tuple) and isinstance(expected, list | tuple):
        return len(value) == len(expected) and all(map(_alike, value, expected))
    return bool(value == expected)
