"""Which of several start values of a parameter a node gets: rcl says nothing about it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import yaml

INFO, WARN = 20, 30
_GROUPS = (
    "ROS collects the values under each name of a node, in the order in which the names first occur, and "
    "the last name wins"
)
_OF_LAUNCH = "launch_params_"  # begins the name of the folder in which launch_ros writes dictionaries


class _Start(NamedTuple):
    """A start value. key: the name of nodes above `ros__parameters`."""

    name: str
    value: Any
    key: str
    place: str


def competing_values(
    arguments: Sequence[str], node: str, taken: Mapping[str, Any]
) -> Iterator[tuple[int, str]]:
    """For each parameter of a node that was given different values, which one it got: a level and a sentence.

    arguments: those of its program, after `--ros-args`. taken: the value that the node got, by name.
    """
    given: dict[str, list[_Start]] = {}
    for start in _starts(arguments, node):
        given.setdefault(start.name, []).append(start)
    for name, starts in given.items():
        others = [
            f"{_text(start.value)} ({start.place})" for start in starts if start.value != taken.get(name)
        ]
        won = next((start for start in reversed(starts) if start.value == taken.get(name)), None)
        if won is None or not others:
            continue
        line = (
            f"{node}: `{name}` is {_text(won.value)} ({won.place}); it was also given {' and '.join(others)}."
        )
        if won.value == starts[-1].value:
            yield INFO, line
            continue
        keys = ", then ".join(f"`{key}`" for key in dict.fromkeys(start.key for start in starts))
        yield WARN, f"{line} {_GROUPS}, here {keys}. Use one name in all of them."


def _starts(arguments: Sequence[str], node: str) -> Iterator[_Start]:
    for word, value in pairwise(arguments):
        if word in ("-p", "--param"):
            rule, _, text = value.partition(":=")
            key, colon, name = rule.rpartition(":")
            if _matches(key if colon else "/**", node):
                yield _Start(name, _read(text), key if colon else "/**", "an argument")
        elif word == "--params-file":
            file = Path(value)
            place = "the launch file" if file.parent.name.startswith(_OF_LAUNCH) else file.name
            for key, values in _tables(_read(_text_of(file)), ""):
                if _matches(key, node):
                    yield from (_Start(name, each, key, place) for name, each in _flat(values, ""))


def _read(text: str) -> Any:
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError:
        return None


def _text_of(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return ""


def _tables(data: Any, key: str) -> Iterator[tuple[str, Any]]:
    """The tables of parameters in a file, with the names of nodes above them."""
    for name, inner in data.items() if isinstance(data, dict) else ():
        if name == "ros__parameters":
            yield key, inner
        else:
            yield from _tables(inner, f"{key}/{name}" if key else str(name))


def _flat(values: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    for name, value in values.items() if isinstance(values, dict) else ():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value


def _matches(key: str, node: str) -> bool:
    """Return whether a name such as `/**`, `/*/arm`, `/left/arm` or `arm` is this node's full name."""
    parts = re.split(r"(/?\*\*|\*)", key if key.startswith("/") else f"/{key}")
    wild = {"/**": ".*", "**": ".*", "*": "[^/]+"}
    return re.fullmatch("".join(wild.get(part, re.escape(part)) for part in parts), node) is not None


def _text(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, default=str)
