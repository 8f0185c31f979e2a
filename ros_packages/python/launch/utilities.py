"""Converts the arguments of actions: to lists of substitutions, to texts and to values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import yaml

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, TextSubstitution


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """A text, a substitution or several of both, as a list of substitutions. Raises TypeError."""
    if isinstance(subs, str | Substitution):
        subs = [subs]
    found = []
    for part in subs:
        if not isinstance(part, str | Substitution):
            raise TypeError(
                f"Failed to normalize given item of type '{type(part)}', "
                "when only 'str' or 'launch.Substitution' were expected."
            )
        found.append(TextSubstitution(text=part) if isinstance(part, str) else part)
    return found


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """The text that a list of substitutions is replaced by."""
    return "".join(context.perform_substitution(sub) for sub in subs)


def describe_substitutions(subs: Iterable[Substitution]) -> str:
    """A description of a list of substitutions, for people."""
    return " + ".join(sub.describe() for sub in subs)


def text_of(context: LaunchContext, subs: SomeSubstitutionsType) -> str:
    """The text of an argument that may have substitutions."""
    return perform_substitutions(context, normalize_to_list_of_substitutions(subs))


def value_of(context: LaunchContext, value: Any, kind: type) -> Any:
    """A value of this type, given as such or as text in YAML. Raises ValueError for text of another type."""
    if isinstance(value, bool | int | float):
        return kind(value)
    text = text_of(context, value)
    found = yaml.safe_load(text)
    if kind is float and isinstance(found, int) and not isinstance(found, bool):
        found = float(found)
    if not isinstance(found, kind):
        raise ValueError(f"Failed to convert '{text}' to '{kind}'")
    return found


def ensure_argument_type(argument: Any, types: Any, argument_name: str, caller: str | None = None) -> None:
    """Raise TypeError if an argument has none of these types."""
    kinds = tuple(types) if isinstance(types, Iterable) else (types,)
    if not isinstance(argument, kinds):
        begin = "E" if caller is None else f"'{caller}' e"
        expected = ", ".join(map(str, kinds))
        raise TypeError(
            f"{begin}xpected '{argument_name}' to be one of [{expected}], "
            f"but got '{argument}' of type '{type(argument)}'"
        )
