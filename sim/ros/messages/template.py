"""Messages that are sent often and change little: serialized once, then patched at the fields that change.

A robot's sensors publish thousands of messages in a run. Setting checked fields and serializing costs about
ten times as much as writing the numbers into the CDR bytes.
"""

from __future__ import annotations

import array
import functools
import struct
from collections.abc import Callable, Sequence
from typing import Any

from sim.ros.messages.cdr import Canonical, canonical
from sim.ros.messages.codec import encode, type_name
from sim.ros.messages.decoder import decode_message

_MARK = b"\x11"  # written into a field to find its offset
STAMP = ("header.stamp.sec", "header.stamp.nanosec")
"""The stamp fields of a message with a header."""

_CODES = {"double": "d", "float": "f", "int32": "i", "uint32": "I", "uint8": "B"}  # struct's


class Template:
    """A message with fields that are filled in later.

    fields: paths such as "pose.pose.position.x" or "transforms.0.header.stamp.sec" to a number (float64,
    float32, a 32-bit integer or uint8), or to a float32 sequence, whose length is that in `message`.
    A float64 sequence takes one number for each of its elements.
    """

    def __init__(self, message: Any, fields: Sequence[str]) -> None:
        raw = canonical(type_name(type(message)), encode(message))
        self._filled = _make_fill(type(message), raw, tuple(fields))

    def fill(self, *values: Any) -> bytes:
        """The message's bytes with these values, in the order of the fields; float32 sequences as bytes."""
        return Canonical(self._filled(*values))


_Slot = tuple[int, str]  # a value's offset in the bytes, and its code for struct


@functools.lru_cache(maxsize=256)  # robots of all runs share a few
def _make_fill(cls: type, raw: bytes, fields: tuple[str, ...]) -> Callable[..., bytes]:
    """A function that packs the values and the constant bytes between them in a single call."""
    message = decode_message(cls, raw)
    slots = [slot for field in fields for slot in _find(message, field)]
    values = [f"value{number}" for number in range(len(slots))]
    format_, at = "<", 0
    parts: list[str] = []
    known: dict[str, Any] = {}
    for (offset, code), value in sorted(zip(slots, values, strict=True)):
        known[f"before_{value}"] = raw[at:offset]
        parts += [f"before_{value}", value]
        format_ += f"{offset - at}s{code}"
        at = offset + struct.calcsize(f"<{code}")
    known |= {"pack": struct.Struct(f"{format_}{len(raw) - at}s").pack, "end": raw[at:]}
    return eval(f"lambda {', '.join(values)}: pack({', '.join(parts)}, end)", known)


def _find(message: Any, field: str) -> list[_Slot]:
    *path, name = field.split(".")
    owner = message
    for step in path:
        owner = _get(owner, step)
    before = _get(owner, name)
    if isinstance(before, array.array):
        size = len(before) * before.itemsize
        mark = array.array(before.typecode, _MARK * size)
        codes = [f"{size}s"] if before.typecode == "f" else ["d"] * len(before)
    else:
        whole = hasattr(owner, "get_fields_and_field_types")  # else it is an array, of float64
        codes = [_CODES[owner.get_fields_and_field_types()[name]] if whole else "d"]
        size = struct.calcsize(f"<{codes[0]}")
        mark = struct.unpack(f"<{codes[0]}", _MARK * size)[0]
    _set(owner, name, mark)
    raw = canonical(type_name(type(message)), encode(message))
    _set(owner, name, before)
    offset = raw.index(_MARK * size)
    return [(offset + 8 * index, code) for index, code in enumerate(codes)]


def _get(owner: Any, step: str) -> Any:
    return owner[int(step)] if step.isdecimal() else getattr(owner, step)


def _set(owner: Any, step: str, value: Any) -> None:
    if step.isdecimal():
        owner[int(step)] = value
    else:
        setattr(owner, step, value)
