"""Values, such as fields of messages and requests: described in words and compared with the expected ones."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence
from typing import Any

from sim.evidence import since_start

LONGEST = 120  # characters of a message in words
MOST = 8  # values of a list in words

# Where a ParameterValue holds its value, by its type.
_VALUE = ("", "bool_value", "integer_value", "double_value", "string_value", "byte_array_value",
          "bool_array_value", "integer_array_value", "double_array_value", "string_array_value")  # fmt: skip


def message_text(message: Any) -> str:
    """A message in words: "a=2, b=3"; cut where it gets long."""
    text = words(plain(message))
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def words(values: Mapping[str, Any]) -> str:
    """Values in words: "success=True, message='armed'"."""
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def stamp_words(stamp: Any) -> str:
    """The stamp of a message in words: when in the run that was, or just what it is where it was before."""
    seconds = since_start(stamp)
    return f"{seconds:.3f} s" if seconds >= 0 else words({"sec": stamp.sec, "nanosec": stamp.nanosec})


def listed(values: Sequence[Any]) -> str:
    """The first of some values in words: "1, 2, 3"."""
    return ", ".join(map(str, values[:MOST])) + (", ..." if len(values) > MOST else "")


def plain(message: Any) -> dict[str, Any]:
    """The fields of a message and their values.

    The services of parameters are read as one speaks of them: a request gives the parameters' own names and
    values; a response gives the value (a list of them, for several), or successful and reason.
    """
    values: dict[str, Any] = {}
    for name, kind in message.get_fields_and_field_types().items():
        value = read(message, name)
        values |= _parameters(kind, value) or {name: value}
    return values


def _parameters(kind: str, items: Any) -> dict[str, Any]:
    """Return what a field of the services of parameters says; {} for any other field."""
    if kind == "sequence<rcl_interfaces/Parameter>":
        return {item.name: _value(item.value) for item in items}
    if kind == "sequence<rcl_interfaces/ParameterValue>":
        found = [_value(item) for item in items]
        return {"value": found[0] if len(found) == 1 else found}
    if kind == "sequence<rcl_interfaces/SetParametersResult>" and items:
        reasons = [item.reason for item in items if item.reason]
        return {"successful": all(item.successful for item in items), "reason": "; ".join(reasons)}
    return {}


def _value(value: Any) -> Any:
    """Return what a ParameterValue holds; None where it is not set."""
    return read(value, _VALUE[value.type]) if value.type else None


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
