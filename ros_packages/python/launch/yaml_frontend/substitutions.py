"""Parses the substitutions of launch files in YAML, such as $(var NAME)."""

from __future__ import annotations

import re
from collections.abc import Callable

from launch.substitution import Substitution
from launch.substitutions import (
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    LaunchConfiguration,
    NotEqualsSubstitution,
    PythonExpression,
    TextSubstitution,
    ThisLaunchFileDir,
)

# By name: the least and the greatest number of arguments, and the function that makes the substitution.
SUBSTITUTIONS: dict[str, tuple[int, int, Callable[..., Substitution]]] = {
    "var": (1, 2, lambda name, default=None: LaunchConfiguration(name, default=default)),
    "env": (1, 2, lambda name, default=None: EnvironmentVariable(name, default_value=default)),
    "eval": (1, 1, PythonExpression),
    "dirname": (0, 0, ThisLaunchFileDir),
    "command": (1, 2, lambda command, on_stderr="fail": Command(command, on_stderr=on_stderr)),
    "equals": (2, 2, EqualsSubstitution),
    "not-equals": (2, 2, NotEqualsSubstitution),
}
OF_ROS1 = {"find": "find-pkg-share", "arg": "var", "optenv": "env"}
NAME = re.compile(r"\$\(([A-Za-z][\w-]*)")


def parse_substitution(text: str) -> list[Substitution]:
    """The parts of a text such as "$(var name)/scan". Raises ValueError if it can't be parsed."""
    parts, end = _parse_until(text, 0, "")
    if end < len(text):
        raise ValueError(f"{text!r} can't be read from {text[end:]!r} on.")
    return parts or [TextSubstitution(text=text)]


def _parse_until(text: str, at: int, stop: str) -> tuple[list[Substitution], int]:
    """The parts before the first character in `stop`, and where that is."""
    parts: list[Substitution] = []
    plain = ""
    while at < len(text) and text[at] not in stop:
        if text[at] == "\\" and at + 1 < len(text):
            plain, at = plain + text[at + 1], at + 2
        elif text.startswith("$(", at):
            parts += [TextSubstitution(text=plain)] if plain else []
            part, at = _parse_one(text, at)
            parts.append(part)
            plain = ""
        else:
            plain, at = plain + text[at], at + 1
    return [*parts, *([TextSubstitution(text=plain)] if plain else [])], at


def _parse_one(text: str, at: int) -> tuple[Substitution, int]:
    match = NAME.match(text, at)
    if match is None:
        raise ValueError(f"{text!r} can't be read from {text[at:]!r} on.")
    name, at = match[1], match.end()
    if name not in SUBSTITUTIONS:
        if name in OF_ROS1:
            raise RuntimeError(f"$({name} ...) is of ROS 1: ROS 2 has $({OF_ROS1[name]} ...).")
        raise RuntimeError(f"Unknown substitution: {name}. There are {', '.join(sorted(SUBSTITUTIONS))}.")
    arguments = []
    while text.startswith(" ", at):
        at += 1
        if text[at : at + 1] in ("'", '"'):
            value, at = _parse_until(text, at + 1, text[at])
            at += 1
        else:
            value, at = _parse_until(text, at, " )")
        arguments.append(value)
    if not text.startswith(")", at):
        raise ValueError(f"{text!r} can't be read: there is no ) at the end of $({name} ...")
    least, most, make = SUBSTITUTIONS[name]
    if not least <= len(arguments) <= most:
        wanted = str(least) if least == most else f"{least} or {most}"
        raise TypeError(f"{name} substitution expects {wanted} argument(s), not {len(arguments)}")
    return make(*arguments), at + 1
