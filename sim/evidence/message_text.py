"""Messages as lines of text and as numbers, for the live view and the replay."""

from __future__ import annotations

import numbers
from collections.abc import Iterator
from typing import Any, Protocol

MAX_ITEMS = 6  # shown of each list
MAX_LINES = 40  # shown of a message
MAX_CHARACTERS = 200  # shown of a value
JOINT_FIELDS = ("position", "velocity", "effort")  # of sensor_msgs/msg/JointState
SKIPPED_FIELDS = ("header", "covariance", "stamp")  # whose numbers are not plotted


class TopicMessage(Protocol):
    """A message with its topic, its type and its stamp (s); reading `message` may decode it."""

    @property
    def topic(self) -> str:
        """Its topic."""

    @property
    def type(self) -> str:
        """Its type."""

    @property
    def stamp(self) -> float:
        """Its stamp (s)."""

    @property
    def message(self) -> Any:
        """The decoded message."""


def decoded(item: Any) -> Any:
    """The message of a row of a recording, or None if its bytes are invalid."""
    try:
        return item.message
    except Exception:  # a student's node may have sent any bytes
        return None


def field_lines(message: Any, before: str = "", indent: str = "") -> Iterator[tuple[str, str]]:
    """The fields of a message with their lines as `ros2 topic echo` prints them, long lists abbreviated."""
    for name, part in _fields(message):
        field = f"{before}{name}"
        if hasattr(part, "get_fields_and_field_types"):
            yield field, f"{indent}{name}:"
            yield from field_lines(part, f"{field}.", indent + "  ")
        elif hasattr(part, "__len__") and not isinstance(part, str | bytes):
            yield from _list(field, name, list(part), indent)
        else:
            yield field, f"{indent}{name}: {_format_value(part)}"


def text_lines(message: Any) -> list[str]:
    """The lines of a message; of a long one the first, and how many more there are."""
    lines = [line for _, line in field_lines(message)]
    more = [f"... and {len(lines) - MAX_LINES} more lines"] if len(lines) > MAX_LINES else []
    return lines[:MAX_LINES] + more


def numbers_to_plot(message: Any) -> Iterator[tuple[str, float]]:
    """The numeric fields of a message outside lists; of joints' states "elbow_joint position" and so on."""
    yield from single_numbers(message)
    joints = list(getattr(message, "name", ()))
    for field in JOINT_FIELDS if joints and not isinstance(message.name, str) else ():
        values = getattr(message, field, ())
        yield from ((f"{joint} {field}", float(value)) for joint, value in zip(joints, values, strict=False))


def single_numbers(message: Any, before: str = "") -> Iterator[tuple[str, float]]:
    """The numeric fields of a message, outside lists, without those of its header."""
    for name, part in _fields(message) if message is not None else ():
        if name in SKIPPED_FIELDS:
            continue
        if hasattr(part, "get_fields_and_field_types"):
            yield from single_numbers(part, f"{before}{name}.")
        elif isinstance(part, numbers.Real):
            yield f"{before}{name}", float(part)


def long_lists(message: Any) -> Iterator[tuple[str, list[float]]]:
    """The fields of a message that are long lists of numbers."""
    for name, part in _fields(message):
        if hasattr(part, "__len__") and not isinstance(part, str | bytes) and len(part) > MAX_ITEMS:
            values = [float(value) for value in part if isinstance(value, numbers.Real)]
            if len(values) == len(part):
                yield name, values


def _fields(message: Any) -> Iterator[tuple[str, Any]]:
    for name in message.get_fields_and_field_types():
        yield name, getattr(message, name)


def _list(field: str, name: str, items: list[Any], indent: str) -> Iterator[tuple[str, str]]:
    if items and hasattr(items[0], "get_fields_and_field_types"):
        yield field, f"{indent}{name}: {len(items)} of these:"
        yield from field_lines(items[0], f"{field}.0.", indent + "- ")
        return
    rest = f", ... {len(items)} in all" if len(items) > MAX_ITEMS else ""
    yield field, f"{indent}{name}: [{', '.join(map(_format_value, items[:MAX_ITEMS]))}{rest}]"


def _format_value(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)[:MAX_CHARACTERS]
