"""Message objects from their bytes, without what rclpy does on the way there.

rclpy makes each message with all its parts at their defaults, and puts each part that it has read in place of
one of these, parts of parts included. Here each part is made once: five to ten times as fast, and the same.
"""

from __future__ import annotations

import array
import functools
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message
from rosidl_parser.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString

from sim.ros.messages.cdr import HEADER, LITTLE_ENDIAN_PLAIN, SIZES
from sim.ros.messages.codec import message_class

# Each reader takes the bytes of a message and a place there, and gives a value and the place behind it.
Reader = Callable[[bytes, int], tuple[Any, int]]

# rosidl's basic types, as the modules struct and array call them; rclpy has other objects for the rest.
CODES = {
    "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
    "uint32": "I", "int64": "q", "uint64": "Q",
}  # fmt: skip
_LENGTH = struct.Struct("<I")


class _Unknown(Exception):
    """The type has a part that only ROS reads."""


def decode(name: str, raw: bytes) -> Any:
    """The message of the type of this name that these bytes are. Raises RMWError for bytes that are none."""
    return decode_message(message_class(name), raw)


def decode_message(cls: type, raw: bytes) -> Any:
    """The message of this class that these bytes are. Raises RMWError for bytes that are none."""
    read = _message_reader(cls)
    if read is not None and raw[:2] == LITTLE_ENDIAN_PLAIN:
        try:
            return read(raw, HEADER)[0]
        except (struct.error, ValueError, IndexError):
            pass  # whatever is wrong with them, ROS has the last word
    return deserialize_message(raw, cls)


@functools.cache
def _message_reader(cls: type) -> Reader | None:
    try:
        return _of_message(cls)
    except _Unknown:
        return None


def _of_message(cls: type) -> Reader:
    if not cls.SLOT_TYPES:
        raise _Unknown
    fields = [
        (vars(cls)[slot].__set__, _of_field(type_))
        for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=False)  # one slot more, see below
    ]
    set_checks, checks, new = vars(cls)["_check_fields"].__set__, cls()._check_fields, cls.__new__

    def read(raw: bytes, at: int) -> tuple[Any, int]:
        message = new(cls)
        for put, read_field in fields:
            value, at = read_field(raw, at)
            put(message, value)
        set_checks(message, checks)
        return message, at

    return read


def _of_field(type_: Any) -> Reader:
    if isinstance(type_, NamespacedType):
        return _of_message(message_class("/".join((*type_.namespaces, type_.name))))
    if isinstance(type_, UnboundedString):
        return _read_string
    if isinstance(type_, BasicType):
        return _read_boolean if type_.typename == "boolean" else _of_number(type_)
    if not isinstance(type_, Array | UnboundedSequence):
        raise _Unknown
    numbers = isinstance(type_.value_type, BasicType)
    if isinstance(type_, Array):
        return _of_number_array(type_) if numbers else _of_array(type_)
    return _of_number_sequence(type_.value_type) if numbers else _of_sequence(type_.value_type)


def _code(type_: BasicType) -> tuple[str, int]:
    if type_.typename not in CODES:
        raise _Unknown
    return CODES[type_.typename], SIZES[type_.typename]


def _of_number(type_: BasicType) -> Reader:
    code, size = _code(type_)
    unpack = struct.Struct(f"<{code}").unpack_from

    def read(raw: bytes, at: int) -> tuple[Any, int]:
        at += (HEADER - at) % size
        return unpack(raw, at)[0], at + size

    return read


def _read_boolean(raw: bytes, at: int) -> tuple[bool, int]:
    return (False, True)[raw[at]], at + 1


def _read_length(raw: bytes, at: int) -> tuple[int, int]:
    at += (HEADER - at) % 4
    return _LENGTH.unpack_from(raw, at)[0], at + 4


def _part(raw: bytes, at: int, size: int) -> bytes:
    part = raw[at : at + size]
    if len(part) != size:
        raise ValueError("the bytes end too early")
    return part


def _read_string(raw: bytes, at: int) -> tuple[str, int]:
    length, at = _read_length(raw, at)
    text = _part(raw, at, length).split(b"\0", 1)[0]
    return text.decode("utf-8", "replace"), at + length


def _of_number_array(type_: Array) -> Reader:
    code, size = _code(type_.value_type)
    dtype, count = np.dtype(f"<{code}"), type_.size

    def read(raw: bytes, at: int) -> tuple[np.ndarray, int]:
        at += (HEADER - at) % size
        return np.frombuffer(raw, dtype, count, at).copy(), at + count * size

    return read


def _of_number_sequence(type_: BasicType) -> Reader:
    code, size = _code(type_)

    def read(raw: bytes, at: int) -> tuple[array.array, int]:
        length, at = _read_length(raw, at)
        values = array.array(code)
        if length:
            at += (HEADER - at) % size
            values.frombytes(_part(raw, at, length * size))
        return values, at + length * size

    return read


def _of_array(type_: Array) -> Reader:
    read_one, count = _of_field(type_.value_type), type_.size
    return lambda raw, at: _several(read_one, count, raw, at)


def _of_sequence(type_: Any) -> Reader:
    read_one = _of_field(type_)

    def read(raw: bytes, at: int) -> tuple[list[Any], int]:
        length, at = _read_length(raw, at)
        if length > len(raw):
            raise ValueError("the bytes end too early")
        return _several(read_one, length, raw, at)

    return read


def _several(read_one: Reader, count: int, raw: bytes, at: int) -> tuple[list[Any], int]:
    values = []
    for _ in range(count):
        value, at = read_one(raw, at)
        values.append(value)
    return values, at
