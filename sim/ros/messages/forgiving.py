"""What a program would have done without a slip: messages take 1 for 1.0, and Float32 passes for Float64.

And whoever asks for a parameter gets the one of nearly that name, which takes 0.5 where its default is 0.
"""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from numbers import Integral, Real
from typing import Any

from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from std_msgs.msg import Float32, Float64

from sim.suggestions import closest_ros_name

_INTERFACES = re.compile(r"\w+\.(msg|srv|action)\._\w+")
_FLOATS = {"float", "double"}
_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_OTHER = {Float32: Float64, Float64: Float32}
_lenient: set[type] = set()  # classes whose fields can be lenient, and are as long as somebody wants it
_wanted: list[object] = []  # one for each of those


@contextlib.contextmanager
def forgiving() -> Iterator[None]:
    """While it lasts, fields of all messages that are loaded take numbers of the other kind, if equal.

    And Float32 and Float64 pass for each other where a topic has one of them: see the functions below.
    """
    for name, module in list(sys.modules.items()):
        if _INTERFACES.fullmatch(name):
            for item in list(vars(module).values()):
                if isinstance(item, type) and item.__module__ == name and item not in _lenient:
                    _make_lenient(item)
    _wanted.append(object())
    try:
        yield
    finally:
        _wanted.pop()


def _make_lenient(message_class: type) -> None:
    _lenient.add(message_class)
    for name, kind in vars(message_class).get("_fields_and_field_types", {}).items():
        strict = vars(message_class).get(name)
        if isinstance(strict, property) and kind in _FLOATS | _INTEGERS:
            setattr(message_class, name, _lenient_property(strict, kind in _FLOATS))


def _lenient_property(strict: property, is_float: bool) -> property:
    def put(message: Any, value: Any) -> None:
        strict.fset(message, _fitting(value, is_float) if _wanted else value)

    return property(strict.fget, put, doc=strict.__doc__)


def _fitting(value: Any, is_float: bool) -> Any:
    """The value as a number of the field's kind, where it is one; else as it is: the field refuses it."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return value
    if is_float:
        return float(value)
    return int(value) if isinstance(value, Integral) or float(value).is_integer() else value


def of_a_type_that_fits(make: Callable[[Any], Any], msg_type: Any) -> Any:
    """The end of a topic that `make` makes for this type; of the other float where the topic has that.

    Raises RCLError as `make` does, where the program is not forgiven, or neither fits.
    """
    try:
        return make(msg_type)
    except _rclpy.RCLError:
        if not _wanted or msg_type not in _OTHER:
            raise
        return make(_OTHER[msg_type])


def fitting(message: Any, msg_type: Any) -> Any:
    """The message for a publisher of this type; of the other float, if the program is forgiven that."""
    if _wanted and _OTHER.get(type(message)) is msg_type:
        return msg_type(data=message.data)
    return message


def real(parameters: Sequence[Any]) -> Sequence[Any]:
    """What a node declares; whole numbers as real ones, if the program is forgiven that."""
    if not _wanted:
        return parameters
    return [
        (row[0], float(row[1]), *row[2:]) if len(row) > 1 and type(row[1]) is int else row
        for row in parameters
    ]


def meant(name: str, declared: Iterable[str]) -> str:
    """The parameter that is asked for; of a program that is forgiven a slip, the one of nearly that name."""
    declared = list(declared)
    return name if not _wanted or name in declared else closest_ros_name(name, declared) or name
