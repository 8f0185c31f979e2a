"""Canonical message bytes: equal messages, equal bytes.

CDR aligns each value to its size, and Fast CDR does not initialize the padding and the bytes after the end.
`canonical` clears the padding and removes the trailing bytes, so that recordings can be compared as bytes.
Layout: DDS-XTypes 1.3, 7.4 (plain CDR).
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractSequence,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
)

from sim.ros.messages.codec import message_class

HEADER = 4  # bytes of encapsulation; alignment is relative to their end
LITTLE_ENDIAN_PLAIN, NO_OPTIONS = b"\x00\x01", b"\x00\x00"
SIZES = {
    **dict.fromkeys(("boolean", "octet", "char", "int8", "uint8"), 1),
    **dict.fromkeys(("int16", "uint16"), 2),
    **dict.fromkeys(("int32", "uint32", "float"), 4),
    **dict.fromkeys(("int64", "uint64", "double"), 8),
}
NUMBERS = SIZES.keys() - {"boolean", "octet", "char"}  # types of which every bit pattern is a value
# A layout is a tuple of steps; each step is one of these kinds with its arguments.
VALUES, STRING, VALUE_SEQUENCE, SEQUENCE, ARRAY = range(5)


class Canonical(bytes):
    """Bytes that are known to be canonical."""


class _NoLayout(Exception):
    """The type has a field whose layout is not supported."""


def canonical(type_name: str, raw: bytes) -> bytes:
    """The bytes of a message with all padding zero and without trailing bytes."""
    if isinstance(raw, Canonical):
        return raw
    layout = _layout_of(type_name)
    if layout is None or raw[:2] != LITTLE_ENDIAN_PLAIN:
        return raw
    if len(layout) == 1 and layout[0][0] is VALUES:
        return raw[: HEADER + layout[0][2]]
    buffer = bytearray(raw)
    try:
        end = _walk(buffer, HEADER, layout)
    except ValueError:
        return raw  # a student may publish any bytes
    return bytes(buffer[:end])


def is_canonical(type_name: str, raw: bytes) -> bool:
    """Return whether these are canonical bytes of this type's message, checked without decoding values.

    Also False for a type whose validity depends on its values, such as a boolean or a bounded sequence.
    """
    layout = _layout_checked_by_size(type_name)
    if layout is None or raw[:HEADER] != LITTLE_ENDIAN_PLAIN + NO_OPTIONS:
        return False
    if len(layout) == 1 and layout[0][0] is VALUES:
        return len(raw) == HEADER + layout[0][2]
    buffer = bytearray(raw)
    try:
        end = _walk(buffer, HEADER, layout, strict=True)
    except ValueError:
        return False
    return end == len(raw) and buffer == raw


def clear_layout_cache() -> None:
    """Forget all layouts: a name may refer to another class by now."""
    _layout_of.cache_clear()
    _layout_checked_by_size.cache_clear()


@functools.cache
def _layout_of(type_name: str) -> tuple | None:
    try:
        return _steps(message_class(type_name))
    except _NoLayout:
        return None


def _steps(cls: type[Any]) -> tuple:
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
    width, size = inner[0][1:] if len(inner) == 1 and inner[0][0] is VALUES else (0, 0)
    if isinstance(slot, Array):
        return ((VALUES, width, size * slot.size),) if width else ((ARRAY, inner, slot.size),)
    return ((VALUE_SEQUENCE, width, size),) if width else ((SEQUENCE, inner),)


def _align(buffer: bytearray, at: int, size: int) -> int:
    gap = -(at - HEADER) % size
    if gap:
        buffer[at : at + gap] = bytes(gap)
    return at + gap


def _length(buffer: bytearray, at: int) -> tuple[int, int]:
    at = _align(buffer, at, 4)
    return int.from_bytes(buffer[at : at + 4], "little"), at + 4


def _walk(buffer: bytearray, at: int, layout: tuple, strict: bool = False) -> int:
    """Clear all padding; returns the message's end. Raises ValueError if the bytes end within a sequence.

    strict: also raises ValueError for a string that ROS would write differently.
    """
    for step in layout:
        kind = step[0]
        if kind is VALUES:
            at = _align(buffer, at, step[1]) + step[2]
        elif kind is STRING:
            length, at = _length(buffer, at)
            if strict:
                _check_text(buffer[at : at + length], length)
            at += length
        elif kind is VALUE_SEQUENCE:
            length, at = _length(buffer, at)
            if length:
                at = _align(buffer, at, step[1]) + length * step[2]
        else:
            length, at = _length(buffer, at) if kind is SEQUENCE else (step[2], at)
            for _ in range(length):
                at = _walk(buffer, at, step[1], strict)
                if at > len(buffer):
                    raise ValueError("the bytes end too early")
    return at


def _check_text(text: bytes, length: int) -> None:
    if not length or text.find(b"\0") != length - 1:
        raise ValueError("a text ends with its only zero")
    text.decode()


@functools.cache
def _layout_checked_by_size(type_name: str) -> tuple | None:
    return _layout_of(type_name) if _are_checked_by_size(message_class(type_name).SLOT_TYPES) else None


def _are_checked_by_size(slots: Sequence[Any]) -> bool:
    """Return whether any bytes of the right sizes are valid values of these slots; False without slots."""
    for slot in slots:
        if isinstance(slot, NamespacedType):
            checked = _are_checked_by_size(message_class("/".join((*slot.namespaces, slot.name))).SLOT_TYPES)
        elif isinstance(slot, Array | UnboundedSequence):
            checked = _are_checked_by_size([slot.value_type])
        else:
            checked = isinstance(slot, UnboundedString) or getattr(slot, "typename", "") in NUMBERS
        if not checked:
            return False
    return bool(slots)
