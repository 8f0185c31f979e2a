"""Canonical message bytes: equal messages, equal bytes.

CDR aligns each value to its size, and Fast CDR leaves whatever was in memory in the gaps and behind the
end. `canonical` clears the gaps and cuts the end, so that recordings can be compared byte by byte. Layout:
DDS-XTypes 1.3, 7.4 (plain CDR).
"""

from __future__ import annotations

import functools
from typing import Any

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractSequence,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)

from sim.ros.messages.codec import message_class

HEADER = 4  # bytes of encapsulation; alignment counts from behind them
LITTLE_ENDIAN_PLAIN, NO_OPTIONS = b"\x00\x01", b"\x00\x00"
SIZES = {
    **dict.fromkeys(("boolean", "octet", "char", "int8", "uint8"), 1),
    **dict.fromkeys(("int16", "uint16"), 2),
    **dict.fromkeys(("int32", "uint32", "float"), 4),
    **dict.fromkeys(("int64", "uint64", "double"), 8),
}
# A layout is a tuple of steps; each step is one of these kinds with its arguments.
VALUES, STRING, VALUE_SEQUENCE, SEQUENCE, ARRAY = range(5)


class Canonical(bytes):
    """Bytes that are known to be canonical."""


class _NoLayout(Exception):
    """The type has a part whose layout isn't known here."""


def canonical(type_name: str, raw: bytes) -> bytes:
    """The bytes of a message with all gaps zero and nothing behind its end."""
    if isinstance(raw, Canonical):
        return raw
    layout = _layout_of(type_name)
    if layout is None or raw[:2] != LITTLE_ENDIAN_PLAIN:
        return raw
    if len(layout) == 1 and layout[0][0] is VALUES:
        return raw[: HEADER + layout[0][2]]
    buffer = bytearray(raw)
    end = _walk(buffer, HEADER, layout)
    return bytes(buffer[:end])


def of_numbers_alone(type_name: str, raw: bytes) -> bool:
    """Whether these are canonical bytes of a type that has only numbers of one size, of more than a byte.

    Of such a type any bytes of the right length are a message. (A single byte may stand for a boolean.)
    """
    layout = _layout_of(type_name)
    if layout is None or len(layout) > 1 or layout[0][0] is not VALUES or layout[0][1] == 1:
        return False
    return raw[:HEADER] == LITTLE_ENDIAN_PLAIN + NO_OPTIONS and len(raw) == HEADER + layout[0][2]


def forget_layouts() -> None:
    """Read all types anew: a name may mean another class by now."""
    _layout_of.cache_clear()


@functools.cache
def _layout_of(type_name: str) -> tuple | None:
    try:
        return _steps(message_class(type_name))
    except _NoLayout:
        return None


def _steps(cls: type) -> tuple:
    steps: list[tuple] = []
    for slot in cls.SLOT_TYPES:
        for step in _step(slot):
            if steps and step[0] is VALUES and steps[-1][0] is VALUES and steps[-1][1] == step[1]:
                steps[-1] = (VALUES, step[1], steps[-1][2] + step[2])
            else:
                steps.append(step)
    return tuple(steps) or ((VALUES, 1, 1),)  # an empty message is sent as one byte


def _step(slot: Any) -> tuple:
    if isinstance(slot, BasicType) and slot.typename in SIZES:
        size = SIZES[slot.typename]
        return ((VALUES, size, size),)
    if isinstance(slot, AbstractWString):
        raise _NoLayout
    if isinstance(slot, AbstractGenericString):
        return ((STRING,),)
    if isinstance(slot, NamespacedType):
        return _steps(message_class("/".join((*slot.namespaces, slot.name))))
    inner = _step(slot.value_type) if isinstance(slot, Array | AbstractSequence) else None
    if inner is None:
        raise _NoLayout
    one_value = len(inner) == 1 and inner[0][0] is VALUES and isinstance(slot.value_type, BasicType)
    if isinstance(slot, Array):
        return (
            ((VALUES, inner[0][1], inner[0][2] * slot.size),) if one_value else ((ARRAY, inner, slot.size),)
        )
    return ((VALUE_SEQUENCE, inner[0][1]),) if one_value else ((SEQUENCE, inner),)


def _align(buffer: bytearray, at: int, size: int) -> int:
    gap = -(at - HEADER) % size
    if gap:
        buffer[at : at + gap] = bytes(gap)
    return at + gap


def _length(buffer: bytearray, at: int) -> tuple[int, int]:
    at = _align(buffer, at, 4)
    return int.from_bytes(buffer[at : at + 4], "little"), at + 4


def _walk(buffer: bytearray, at: int, layout: tuple) -> int:
    for step in layout:
        kind = step[0]
        if kind is VALUES:
            at = _align(buffer, at, step[1]) + step[2]
        elif kind is STRING:
            length, at = _length(buffer, at)
            at += length
        elif kind is VALUE_SEQUENCE:
            length, at = _length(buffer, at)
            if length:
                at = _align(buffer, at, step[1]) + length * step[1]
        else:
            length, at = _length(buffer, at) if kind is SEQUENCE else (step[2], at)
            for _ in range(length):
                at = _walk(buffer, at, step[1])
    return at
