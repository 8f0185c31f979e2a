"""Messages as YAML and CSV, as ros2 commands print and read them."""

from __future__ import annotations

import array
import sys
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import yaml
from rosidl_parser.definition import (
    AbstractNestedType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
)

from sim.ros.messages.codec import message_class
from sim.ros2.system import CliError

SEQUENCES = list, tuple, array.array, np.ndarray
TimeSetter = Callable[[Any], None]  # takes a builtin_interfaces/msg/Time


class Style(NamedTuple):
    """The style in which a message is printed."""

    length: int | None = None  # of texts and sequences; longer ones end with "..."
    no_arr: bool = False  # print only the types of sequences
    no_str: bool = False  # print only the lengths of texts
    flow: bool = False  # print sequences on one line


class _Dumper(yaml.Dumper):  # type: ignore[misc]  # yaml has no types
    """Keeps the order of the fields, and prints each on its own line."""


def _fields(dumper: yaml.Dumper, fields: dict[str, Any]) -> yaml.Node:
    pairs = [(dumper.represent_data(key), dumper.represent_data(value)) for key, value in fields.items()]
    return yaml.MappingNode("tag:yaml.org,2002:map", pairs)


_Dumper.add_representer(dict, _fields)


def as_yaml(message: Any, style: Style = Style()) -> str:  # noqa: B008  (a tuple)
    """A message as YAML, with a final newline."""
    return dump(as_dict(message, style), style)


def as_dict(message: Any, style: Style) -> dict[str, Any]:
    """A message as a dictionary, with values as they are printed."""
    values: dict[str, Any] = _plain(message, None, style)
    return values


def dump(values: dict[str, Any], style: Style) -> str:
    """Return what `as_dict` returns as YAML, with a final newline."""
    look = {"allow_unicode": True, "width": sys.maxsize, "default_flow_style": style.flow}
    text: str = yaml.dump(values, Dumper=_Dumper, **look)
    return text


def as_csv(message: Any, style: Style = Style()) -> str:  # noqa: B008
    """All values of a message, separated by commas."""
    return ",".join(_values(message, None, style))


def _slots(message: Any) -> Iterator[tuple[str, Any, Any]]:
    """Name, type and value of each field."""
    for name, kind in zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True):
        yield name, kind, getattr(message, name)


def _plain(value: Any, kind: Any, style: Style) -> Any:
    match value:
        case bytes():
            text = "".join(map(chr, value[: style.length]))
            return text + "..." if _is_too_long(value, style) else text
        case str():
            if style.no_str:
                return f"<string length: <{len(value)}>>"
            return value[: style.length] + "..." if _is_too_long(value, style) else value
        case list() | tuple() | array.array() | np.ndarray():
            if style.no_arr and kind is not None:
                return _describe_type(value, kind)
            items = [_plain(item, None, style) for item in value[: style.length]]
            return [*items, "..."] if _is_too_long(value, style) else items
        case np.number():
            return value.item()
        case bool() | int() | float():
            return value
    return {name: _plain(inner, slot, style) for name, slot, inner in _slots(value)}


def _is_too_long(value: Any, style: Style) -> bool:
    return style.length is not None and len(value) > style.length


def _values(value: Any, kind: Any, style: Style) -> Iterator[str]:
    if isinstance(value, SEQUENCES):
        if style.no_arr and kind is not None:
            yield _describe_type(value, kind)
            return
        for item in value[: style.length]:
            yield from _values(item, None, style)
        if _is_too_long(value, style):
            yield "..."
    elif isinstance(value, bool | bytes | float | int | str | np.number):
        yield str(_plain(value, None, style))
    else:
        for _, slot, inner in _slots(value):
            yield from _values(inner, slot, style)


def _describe_type(value: Any, kind: Any) -> str:
    inner = kind.value_type
    if isinstance(inner, BasicType):
        name = inner.typename
    elif isinstance(inner, NamespacedType):
        name = "/".join(inner.namespaced_name())
    else:
        name = "string"
    if isinstance(kind, Array):
        return f"<array type: {name}[{kind.size}]>"
    bound = f"[{kind.maximum_size}]" if isinstance(kind, BoundedSequence) else ""
    return f"<sequence type: {name}{bound}, length: {len(value)}>"


UNBALANCED = 'Each { needs its }, and the whole value is in quotes: "{linear: {x: 0.5}}".'


def read_values(text: str) -> Any:
    """The values in a YAML text. Raises CliError for invalid YAML."""
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        more = f"\n{UNBALANCED}" if text.count("{") != text.count("}") else ""
        raise CliError(f"{text!r} is not YAML, such as '{{x: 1.0, y: 2.0}}': {error}{more}") from None
    without_space = _key_with_colon(values)
    if without_space:
        name, _, rest = without_space.partition(":")
        raise CliError(
            f"{text!r} is not what it looks like: YAML needs a space after each colon. "
            f"Write {name}: {rest}, not {without_space}."
        )
    return values


def _key_with_colon(values: Any) -> str:
    """The first key without a value that contains a colon, as in {data:Hello}; "" if there is none."""
    if isinstance(values, list):
        return next(filter(None, map(_key_with_colon, values)), "")
    if not isinstance(values, dict):
        return ""
    for key, value in values.items():
        if value is None and isinstance(key, str) and ":" in key.strip(":"):
            return key
        inner = _key_with_colon(value)
        if inner:
            return inner
    return ""


def fill(message: Any, values: Any, failed: str = "Failed to populate field: {}") -> list[TimeSetter]:
    """Set fields of a message to the given values; returns functions that set fields whose value is "now".

    failed: the format of the error text. Raises CliError for an unknown field or an invalid value.
    """
    setters: list[TimeSetter] = []
    try:
        _fill(message, values, setters)
    except (AttributeError, TypeError, ValueError, AssertionError, OverflowError) as error:
        raise CliError(failed.format(error)) from None
    return setters


def _fill(message: Any, values: Any, setters: list[TimeSetter]) -> None:
    if not isinstance(values, dict):
        kind = type(values).__name__
        raise TypeError(f"Value '{values}' is expected to be a dictionary but is a {kind}")
    slots = {name: kind for name, kind, _ in _slots(message)}
    for name, given in values.items():
        field = getattr(message, name)
        if given == "auto" and type(field).__name__ == "Header":
            setters.append(partial(setattr, field, "stamp"))
        elif given == "now" and type(field).__name__ == "Time":
            setters.append(partial(setattr, message, name))
        else:
            setattr(message, name, _converted(field, slots[name], given, setters))


def _converted(field: Any, kind: Any, given: Any, setters: list[TimeSetter]) -> Any:
    if isinstance(kind, AbstractNestedType) and isinstance(kind.value_type, NamespacedType):
        items = []
        for values in given:
            items.append(message_class("/".join(kind.value_type.namespaced_name()))())
            _fill(items[-1], values, setters)
        return items
    if isinstance(field, array.array):
        return array.array(field.typecode, given)
    if isinstance(field, np.ndarray):
        return np.array(given, dtype=field.dtype)
    if isinstance(kind, NamespacedType):
        made = type(field)()
        _fill(made, given, setters)
        return made
    return given if type(given) is type(field) else type(field)(given)
