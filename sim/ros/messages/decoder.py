"""Decodes messages five to fifteen times as fast as rclpy, with equal results.

rclpy creates each message with default values for all fields, nested ones included, and then replaces them
with the decoded values. Here a function is generated for each type, as dataclasses does, that creates each
value once.
"""

from __future__ import annotations

import array
import functools
import itertools
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message
from rosidl_parser.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString

from sim.ros.messages.cdr import HEADER, LITTLE_ENDIAN_PLAIN, SIZES
from sim.ros.messages.codec import message_class

# A reader takes the bytes of a message and an offset, and returns a value and the offset after it.
FieldReader = Callable[[bytes, int], tuple[Any, int]]

# rosidl's basic types -> type codes of the modules struct and array.
CODES = {
    "float": "f", "double": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
    "uint32": "I", "int64": "q", "uint64": "Q",
}  # fmt: skip
_LENGTH = struct.Struct("<I")


class _Unsupported(Exception):
    """The type has a field that only rclpy can decode."""


def decode(name: str, raw: bytes) -> Any:
    """The message of this type that the bytes encode. Raises RMWError for invalid bytes."""
    return decode_message(message_class(name), raw)


def decode_message(cls: type, raw: bytes) -> Any:
    """The message of this class that the bytes encode. Raises RMWError for invalid bytes."""
    read = _message_reader(cls)
    if read is not None and raw[:2] == LITTLE_ENDIAN_PLAIN:
        try:
            return read(raw, HEADER)[0]
        except (struct.error, ValueError, IndexError):
            pass  # let rclpy decide whether the bytes are invalid
    return deserialize_message(raw, cls)


@functools.cache
def _message_reader(cls: type) -> FieldReader | None:
    try:
        return _of_message(cls)
    except _Unsupported:
        return None


def _of_message(cls: type) -> FieldReader:
    source = _DecoderSource()
    message = source.add(cls)
    return source.compiled(message)


class _DecoderSource:
    """The source of a function that decodes messages of one type, and the names it uses."""

    def __init__(self) -> None:
        self._names: dict[str, Any] = {"new": object.__new__}
        self._lines = ["def read(raw, at):"]
        self._values: list[tuple[str, Any]] = []  # target and type of each value, in the order of the bytes

    def add(self, cls: type[Any]) -> str:
        """Add code that creates a message and its nested ones; returns its variable. Raises _Unsupported."""
        if not cls.SLOT_TYPES:
            raise _Unsupported
        message = f"message{len(self._names)}"
        self._names[f"Of_{message}"] = cls
        self._lines.append(f"{message} = new(Of_{message})")
        self._lines.append(f"{message}._check_fields = {bool(cls()._check_fields)}")
        for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=False):  # __slots__ has one more
            if isinstance(type_, NamespacedType):
                self._lines.append(f"{message}.{slot} = {self.add(_class_of(type_))}")
            else:
                self._values.append((f"{message}.{slot}", type_))
        return message

    def compiled(self, message: str) -> FieldReader:
        """The compiled function that decodes this message."""
        for width, values in itertools.groupby(self._values, lambda value: _width(value[1])):
            self._read(width, *zip(*values, strict=True))
        self._lines.append(f"return {message}, at")
        exec("\n    ".join(self._lines), self._names)
        return self._names["read"]

    def _read(self, width: object, targets: tuple[str, ...], types: tuple[Any, ...]) -> None:
        read = f"read{len(self._names)}"
        if isinstance(width, int):
            numbers = struct.Struct("<" + "".join(CODES[type_.typename] for type_ in types))
            self._names[read] = numbers.unpack_from
            self._lines.append(f"at += ({HEADER} - at) % {width}")
            self._lines.append(f"{', '.join(targets)}, = {read}(raw, at)")
            self._lines.append(f"at += {numbers.size}")
        else:
            self._names[read] = _of_field(types[0])
            self._lines.append(f"{targets[0]}, at = {read}(raw, at)")


def _width(type_: Any) -> object:
    """A number's size, because numbers of one size have no padding between them; else a unique object."""
    number = isinstance(type_, BasicType) and type_.typename in CODES
    return SIZES[type_.typename] if number else object()


def _class_of(type_: NamespacedType) -> type:
    return message_class("/".join((*type_.namespaces, type_.name)))


def _of_field(type_: Any) -> FieldReader:
    if isinstance(type_, NamespacedType):
        return _of_message(_class_of(type_))
    if isinstance(type_, UnboundedString):
        return _read_string
    if isinstance(type_, BasicType) and type_.typename == "boolean":
        return _read_boolean
    if not isinstance(type_, Array | UnboundedSequence):
        raise _Unsupported
    numbers = isinstance(type_.value_type, BasicType)
    if isinstance(type_, Array):
        return _of_number_array(type_) if numbers else _of_array(type_)
    return _of_number_sequence(type_.value_type) if numbers else _of_sequence(type_.value_type)


def _code(type_: BasicType) -> tuple[str, int]:
    if type_.typename not in CODES:
        raise _Unsupported
    return CODES[type_.typename], SIZES[type_.typename]


def _read_boolean(raw: bytes, at: int) -> tuple[bool, int]:
    return (False, True)[raw[at]], at + 1


def _read_length(raw: bytes, at: int) -> tuple[int, int]:
    at += (HEADER - at) % 4
    return _LENGTH.unpack_from(raw, at)[0], at + 4


def _slice(raw: bytes, at: int, size: int) -> bytes:
    piece = raw[at : at + size]
    if len(piece) != size:
        raise ValueError("the bytes end too early")
    return piece


def _read_string(raw: bytes, at: int) -> tuple[str, int]:
    length, at = _read_length(raw, at)
    text = _slice(raw, at, length).split(b"\0", 1)[0]
    return text.decode("utf-8", "replace"), at + length


def _of_number_array(type_: Array) -> FieldReader:
    code, size = _code(type_.value_type)
    dtype, count = np.dtype(f"<{code}"), type_.size

    def read(raw: bytes, at: int) -> tuple[np.ndarray, int]:
        at += (HEADER - at) % size
        return np.frombuffer(raw, dtype, count, at).copy(), at + count * size

    return read


def _of_number_sequence(type_: BasicType) -> FieldReader:
    code, size = _code(type_)

    def read(raw: bytes, at: int) -> tuple[array.array, int]:
        length, at = _read_length(raw, at)
        values = array.array(code)
        if length:
            at += (HEADER - at) % size
            values.frombytes(_slice(raw, at, length * size))
        return values, at + length * size

    return read


def _of_array(type_: Array) -> FieldReader:
    read_one, count = _of_field(type_.value_type), type_.size
    return lambda raw, at: _several(read_one, count, raw, at)


def _of_sequence(type_: Any) -> FieldReader:
    read_one = _of_field(type_)

    def read(raw: bytes, at: int) -> tuple[list[Any], int]:
        length, at = _read_length(raw, at)
        if length > len(raw):
            raise ValueError("the bytes end too early")
        return _several(read_one, length, raw, at)

    return read


def _several(read_one: FieldReader, count: int, raw: bytes, at: int) -> tuple[list[Any], int]:
    values = []
    for _ in range(count):
        value, at = read_one(raw, at)
        values.append(value)
    return values, at
