"""Accepts small mistakes of a program: 1 for 1.0 in a message field, or Float32 for Float64 on a topic.

A misspelled parameter name refers to the parameter with the closest name, and a parameter with an integer
default accepts a float.
"""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from numbers import Integral, Real
from typing import Any

from std_msgs.msg import Float32, Float64

from sim.ros.rclpy_cpp import cpp
from sim.suggestions import closest_ros_name

_INTERFACES = re.compile(r"\w+\.(msg|srv|action)\._\w+")
_FLOATS = {"float", "double"}
_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_OTHER = {Float32: Float64, Float64: Float32}
_prepared: set[type] = set()  # classes whose fields are lenient while `_active` is not empty
_active: list[object] = []  # an object for each active `lenient_fields`


@contextlib.contextmanager
def lenient_fields() -> Iterator[None]:
    """Meanwhile, fields of all loaded messages accept an int for a float and the reverse, if equal.

    Float32 and Float64 are also accepted for each other on topics: see the functions below.
    """
    for name, module in list(sys.modules.items()):
        if _INTERFACES.fullmatch(name):
            for item in list(vars(module).values()):
                if isinstance(item, type) and item.__module__ == name and item not in _prepared:
                    _make_lenient(item)
    _active.append(object())
    try:
        yield
    finally:
        _active.pop()


def _make_lenient(message_class: type) -> None:
    _prepared.add(message_class)
    for name, kind in vars(message_class).get("_fields_and_field_types", {}).items():
        strict = vars(message_class).get(name)
        if isinstance(strict, property) and kind in _FLOATS | _INTEGERS:
            setattr(message_class, name, _lenient_property(strict, kind in _FLOATS))


def _lenient_property(strict: property, is_float: bool) -> property:
    def put(message: Any, value: Any) -> None:
        strict.fset(message, _convert_number(value, is_float) if _active else value)

    return property(strict.fget, put, doc=strict.__doc__)


def _convert_number(value: Any, is_float: bool) -> Any:
    """The value as a number of the field's kind or, if it is none, unchanged: the field refuses it."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return value
    if is_float:
        return float(value)
    return int(value) if isinstance(value, Integral) or float(value).is_integer() else value


def create_with_matching_type(make: Callable[[Any], Any], msg_type: Any) -> Any:
    """Return what `make` returns for this message type or, if the topic has that, for the other float type.

    Raises RCLError as `make` does, if the program is not lenient or neither type matches.
    """
    try:
        return make(msg_type)
    except cpp.RCLError:
        if not _active or msg_type not in _OTHER:
            raise
        return make(_OTHER[msg_type])


def convert_float_message(message: Any, msg_type: Any) -> Any:
    """The message for a publisher of this type, converted to the other float if the program is lenient."""
    if _active and _OTHER.get(type(message)) is msg_type:
        return msg_type(data=message.data)
    return message


def convert_parameters(parameters: Sequence[Any]) -> Sequence[Any]:
    """The declared parameters; integer defaults become floats if the program is lenient."""
    if not _active:
        return parameters
    return [
        (row[0], float(row[1]), *row[2:]) if len(row) > 1 and type(row[1]) is int else row
        for row in parameters
    ]


def convert_override(value: Any, default: Any) -> Any:
    """A start value: a float for 1 or "1.0" where the default is one, if the program is lenient."""
    if not _active or type(default) is not float or isinstance(value, float | bool):
        return value
    try:
        return float(value)
    except (TypeError, ValueError):
        return value


def resolve_parameter_name(name: str, declared: Iterable[str]) -> str:
    """The requested parameter's name or, if the program is lenient, the closest declared name."""
    declared = list(declared)
    return name if not _active or name in declared else closest_ros_name(name, declared) or name
