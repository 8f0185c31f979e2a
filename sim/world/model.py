"""Figures that can be: fields say what they may be, and any other value is refused in one sentence.

A field's type is `float`, `int`, `str`, a tuple, another model or one of those `| None`; limits stand beside:

    @dataclass(frozen=True)
    class LidarModel(Model):
        range_min: Annotated[float, at_least(0, "metres")] = 0.12

What takes two fields to judge goes into `__post_init__`, which ends with `self.refuse(...)` if it must.
"""

from __future__ import annotations

import functools
import sys
import types
from collections.abc import Callable
from numbers import Integral, Real
from typing import Annotated, Any, NamedTuple, NoReturn, Union, get_args, get_origin, get_type_hints


class WorldError(ValueError):
    """A world cannot be found, read, made or used."""


class ModelError(WorldError):
    """A figure that cannot be: `fault` is the sentence without the model's name."""

    def __init__(self, model: str, fault: str) -> None:
        super().__init__(f"{model}: {fault}")
        self.fault = fault


class Wanted(NamedTuple):
    """What a value must be, in words that follow "write ", and as a test of a value of the right type."""

    words: str
    fits: Callable[[Any], bool] = lambda value: True


# Where nothing else bounds a figure: far beyond any robot, and near enough for the physics to stay finite.
_LEAST, _MOST = 0.0001, 1_000_000


def positive(unit: str, most: float = _MOST, least: float = _LEAST) -> Wanted:
    """A number above 0, but not so small that the physics would divide by nothing."""
    return within(least, most, unit)


def at_least(least: float, unit: str) -> Wanted:
    """This number or any greater one."""
    return within(least, _MOST, unit)


def within(least: float, most: float, unit: str = "") -> Wanted:
    """A number from one limit to the other, both included."""
    unit = unit and f" ({unit})"
    return Wanted(f"a number from {least:g} to {most:.7g}{unit}", lambda value: least <= value <= most)


Coordinate = Annotated[float, within(-1000, 1000, "metres")]
Length = Annotated[float, positive("metres", 1000)]
Angle = Annotated[float, Wanted("a finite number (radians)")]

_SHOWN = 80  # characters of a value, in an error
_WORDS = {float: "a finite number", int: "a whole number", str: "a text"}


class Model:
    """Base of frozen dataclasses whose values are checked when one is made.

    Whole numbers become floats, lists tuples, and -0.0 becomes 0.0, where the field says so.

    Raises:
        ModelError: a value is of another type, infinite, not a number, or beyond its limits.
    """

    def __post_init__(self) -> None:
        for key, hint in hints(type(self)).items():
            try:
                # The class is frozen for others; this is still part of making it.
                object.__setattr__(self, key, fit(hint, getattr(self, key)))
            except UnfitError:
                self.refuse(key)

    def refuse(self, key: str, wanted: str | None = None) -> NoReturn:
        """Raise ModelError: this field must be what is `wanted`, a phrase that follows "write "."""
        value = shown(getattr(self, key))
        raise ModelError(type(self).__name__, f"{key} is {value}; write {wanted or words(type(self), key)}.")


@functools.cache
def hints(model: type[Model]) -> dict[str, Any]:
    """The types of a model's fields with what stands beside them."""
    return get_type_hints(model, include_extras=True)


def words(model: type[Model], key: str) -> str:
    """What a field must be, as a phrase that follows "write "."""
    kind, wanted = _parts(hints(model)[key])
    if wanted:
        return wanted[-1].words.replace("a number", _WORDS[int]) if kind is int else wanted[-1].words
    return _WORDS.get(kind) or f"a {kind.__name__}"


def nested(model: type[Model], key: str) -> tuple[type[Model] | None, bool]:
    """The model that a field holds, if it holds one, and whether it is a tuple of such."""
    kind, _ = _parts(hints(model)[key])
    many = get_origin(kind) is tuple
    inner = get_args(kind)[0] if many else kind
    return (inner if isinstance(inner, type) and issubclass(inner, Model) else None), many


def _parts(hint: Any) -> tuple[Any, list[Wanted]]:
    """The type that a hint is about, and what stands beside it."""
    if get_origin(hint) in (Union, types.UnionType):
        hint = get_args(hint)[0]
    kind, *wanted = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    return kind, wanted


def shown(value: object) -> str:
    """A value as a world file would write it, tuples as lists; cut where it is long."""
    try:
        text = repr(_as_list(value))
    except ValueError:  # Python doesn't write out whole numbers of more than 4300 digits
        return "a number of thousands of digits"
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."


def _as_list(value: object) -> object:
    return [_as_list(item) for item in value] if isinstance(value, list | tuple) else value


class UnfitError(Exception):
    """A value that is not what its field's type says."""


def fit(hint: Any, value: Any) -> Any:
    """The value as a field of this type has it.

    Raises:
        UnfitError: it is of another type, infinite, not a number, or beyond the limits.
    """
    origin, inner = get_origin(hint), get_args(hint)
    several, number = isinstance(value, list | tuple), not isinstance(value, bool)
    if origin is Annotated:
        fitted = fit(inner[0], value)
        if all(wanted.fits(fitted) for wanted in inner[1:]):
            return fitted
    elif origin in (Union, types.UnionType):
        return None if value is None else fit(inner[0], value)
    elif origin is tuple and several and inner[1:] == (...,):
        return tuple(fit(inner[0], item) for item in value)
    elif origin is tuple and several and len(value) == len(inner):
        return tuple(map(fit, inner, value))
    elif hint is float and number and isinstance(value, Real) and abs(value) <= sys.float_info.max:
        return float(value) + 0.0  # a zero without a sign, which some libraries would take for less than 0
    elif hint is int and number and isinstance(value, Integral):
        return int(value)
    elif hint is Any or (origin is None and hint not in (int, float) and isinstance(value, hint)):
        return value
    raise UnfitError
