"""Messages that are sent often and change little: made and serialised once, then patched where they change.

A robot's sensors publish thousands of messages in a run. Setting checked fields and serialising costs about
ten times as much as writing the numbers where CDR has them.
"""

from __future__ import annotations

import array
import functools
import struct
from collections.abc import Sequence
from typing import Any

from sim.ros.messages.cdr import Canonical, canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.messages.decoder import decode_message

_MARK = b"\x11"  # fills a field, to find where it is
STAMP = ("header.stamp.sec", "header.stamp.nanosec")
"""The fields of a message with a header that change each time."""

_FLOAT64 = struct.Struct("<d")
_PLACES = {
    "double": _FLOAT64,
    "float": struct.Struct("<f"),
    "int32": struct.Struct("<i"),
    "uint32": struct.Struct("<I"),
    "uint8": struct.Struct("<B"),
}


class Template:
    """A message and the numbers in it that change.

    fields: paths such as "pose.pose.position.x" or "transforms.0.header.stamp.sec" to a number (float64,
    float32, a 32-bit integer or uint8), or to a float32 sequence, whose length stays what it is in `message`.
    A float64 sequence gives one number for each of its elements.
    """

    def __init__(self, message: Any, fields: Sequence[str]) -> None:
        raw = canonical(type_name(type(message)), encode(message))
        self._buffer = bytearray(raw)
        self._writers = _writers(type(message), raw, tuple(fields))

    def fill(self, *values: Any) -> bytes:
        """The message's bytes with these values, in the order of the fields; float32 sequences as bytes."""
        buffer = self._buffer
        for (place, offset), value in zip(self._writers, values, strict=True):
            if place is None:
                buffer[offset : offset + len(value)] = value
            else:
                place.pack_into(buffer, offset, value)
        return Canonical(buffer)


_Writer = tuple[struct.Struct | None, int]  # what writes a value, or None for bytes; and where


@functools.lru_cache(maxsize=256)  # the robots of all runs have the same few
def _writers(cls: type, raw: bytes, fields: tuple[str, ...]) -> list[_Writer]:
    message = decode_message(cls, raw)
    return [writer for field in fields for writer in _find(message, field)]


def _find(message: Any, field: str) -> list[_Writer]:
    *path, name = field.split(".")
    owner = message
    for step in path:
        owner = _get(owner, step)
    before = _get(owner, name)
    if isinstance(before, array.array):
        place = None if before.typecode == "f" else _FLOAT64
        mark = array.array(before.typecode, _MARK * len(before) * before.itemsize)
        size, count = len(before) * before.itemsize, len(before) if place else 1
    else:
        whole = hasattr(owner, "get_fields_and_field_types")  # else it is an array, of float64
        place = _PLACES[owner.get_fields_and_field_types()[name]] if whole else _FLOAT64
        size, count = place.size, 1
        mark = place.unpack(_MARK * size)[0]
    _set(owner, name, mark)
    raw = canonical(type_name(type(message)), encode(message))
    _set(owner, name, before)
    offset = raw.index(_MARK * size)
    return [(place, offset + 8 * index) for index in range(count)]


def _get(owner: Any, step: str) -> Any:
    return owner[int(step)] if step.isdecimal() else getattr(owner, step)


def _set(owner: Any, step: str, value: Any) -> None:
    if step.isdecimal():
        owner[int(step)] = value
    else:
        setattr(owner, step, value)
