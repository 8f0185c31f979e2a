"""Validated dataclasses: each field declares its type and limits; other values raise a one-sentence error.

A field's type is `float`, `int`, `str`, a tuple, another model or one of those `| None`; limits are
annotations:

    @dataclass(frozen=True)
    class LidarModel(Model):
        range_min: Annotated[float, at_least(0, "meters")] = 0.12

A condition on two fields is checked in `__post_init__`, which calls `self.reject(...)` if it doesn't hold.
"""

from __future__ import annotations

import functools
import sys
import types
from collections.abc import Callable
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Annotated, Any, NamedTuple, NoReturn, Union, get_args, get_origin, get_type_hints


class WorldError(ValueError):
    """A world cannot be found, read, generated or simulated."""


class ModelError(WorldError):
    """A parameter has an invalid value. `reason` is the sentence without the model's name."""

    def __init__(self, model: str, reason: str) -> None:
        super().__init__(f"{model}: {reason}")
        self.reason = reason


class Constraint(NamedTuple):
    """A constraint on a value: a phrase that follows "write ", and a test for a value of the right type."""

    phrase: str
    accepts: Callable[[Any], bool] = lambda value: True


# Default limits: far beyond any robot, and small enough for the physics to stay finite.
_LEAST, _MOST = 0.0001, 1_000_000


def positive(unit: str, most: float = _MOST, least: float = _LEAST) -> Constraint:
    """A number above 0, and large enough that the physics doesn't divide by zero."""
    return within(least, most, unit)


def at_least(least: float, unit: str) -> Constraint:
    """A number with this lower limit."""
    return within(least, _MOST, unit)


def within(least: float, most: float, unit: str = "") -> Constraint:
    """A number between two limits, both included."""
    unit = unit and f" ({unit})"
    return Constraint(f"a number from {least:g} to {most:.7g}{unit}", lambda value: least <= value <= most)


Coordinate = Annotated[float, within(-1000, 1000, "meters")]
Length = Annotated[float, positive("meters", 1000)]
Angle = Annotated[float, Constraint("a finite number (radians)")]

_MAX_CHARACTERS = 80  # of a value in an error
_TYPE_PHRASES = {float: "a finite number", int: "a whole number", str: "a text"}


@dataclass(frozen=True)
class Model:
    """Base of frozen dataclasses that validate their values on construction.

    Where the field's type requires it, whole numbers are converted to floats, lists to tuples and -0.0 to
    0.0.

    Raises:
        ModelError: a value is of another type, infinite, not a number, or beyond its limits.
    """

    def __post_init__(self) -> None:
        for key, hint in field_types(type(self)).items():
            try:
                # The class is frozen, but this is still part of the construction.
                object.__setattr__(self, key, convert(hint, getattr(self, key)))
            except InvalidValueError:
                self.reject(key)

    def reject(self, key: str, wanted: str | None = None) -> NoReturn:
        """Raise ModelError for a field. `wanted` is a phrase that follows "write "."""
        value = format_value(getattr(self, key))
        raise ModelError(type(self).__name__, f"{key} is {value}; write {wanted or phrase(type(self), key)}.")


_type_hints: Callable[[Any], dict[str, Any]] = functools.cache(
    functools.partial(get_type_hints, include_extras=True)
)


def field_types(model: type[Model]) -> dict[str, Any]:
    """The types of a model's fields, with their constraints."""
    return _type_hints(model)


def phrase(model: type[Model], key: str) -> str:
    """The valid values of a field, as a phrase that follows "write "."""
    kind, constraints = _split(field_types(model)[key])
    if constraints:
        text = constraints[-1].phrase
        return text.replace("a number", _TYPE_PHRASES[int]) if kind is int else text
    return _TYPE_PHRASES.get(kind) or f"a {kind.__name__}"


def nested_model(model: type[Model], key: str) -> tuple[type[Model] | None, bool]:
    """The model class of a field's value, if it is a model, and whether the field is a tuple of them."""
    kind, _ = _split(field_types(model)[key])
    many = get_origin(kind) is tuple
    inner = get_args(kind)[0] if many else kind
    return (inner if isinstance(inner, type) and issubclass(inner, Model) else None), many


def _split(hint: Any) -> tuple[Any, list[Constraint]]:
    """A type annotation as its type, without None, and its constraints."""
    if get_origin(hint) in (Union, types.UnionType):
        hint = get_args(hint)[0]
    kind, *constraints = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    return kind, constraints


def format_value(value: object) -> str:
    """A value as in a world file, tuples as lists; truncated if it is long."""
    try:
        text = repr(_as_list(value))
    except ValueError:  # Python doesn't print whole numbers of more than 4300 digits
        return "a number of thousands of digits"
    return text if len(text) <= _MAX_CHARACTERS else text[: _MAX_CHARACTERS - 3] + "..."


def _as_list(value: object) -> object:
    return [_as_list(item) for item in value] if isinstance(value, list | tuple) else value


class InvalidValueError(Exception):
    """A value that doesn't have its field's type, or violates a constraint."""


def convert(hint: Any, value: Any) -> Any:
    """The value, converted to a field's type.

    Raises:
        InvalidValueError: it is of another type, infinite, not a number, or beyond the limits.
    """
    origin, inner = get_origin(hint), get_args(hint)
    several = isinstance(value, list | tuple)
    number = isinstance(value, Real) and not isinstance(value, bool)
    if origin is Annotated:
        converted = convert(inner[0], value)
        if all(constraint.accepts(converted) for constraint in inner[1:]):
            return converted
    elif origin in (Union, types.UnionType):
        return None if value is None else convert(inner[0], value)
    elif origin is tuple and several and inner[1:] == (...,):
        return tuple(convert(inner[0], item) for item in value)
    elif origin is tuple and several and len(value) == len(inner):
        return tuple(map(convert, inner, value))
    elif hint is float and number and abs(value) <= sys.float_info.max:
        return float(value) + 0.0  # turns -0.0 into 0.0; some libraries treat -0.0 as negative
    elif hint is int and number and isinstance(value, Integral):
        return int(value)
    elif hint is Any or (origin is None and hint not in (int, float) and isinstance(value, hint)):
        return value
    raise InvalidValueError
