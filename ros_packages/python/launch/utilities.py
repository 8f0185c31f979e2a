"""Texts with substitutions in them, as lists of substitutions and as what comes of these."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import yaml

from launch.entities import SomeSubstitutionsType, Substitution
from launch.launch_context import LaunchContext


def normalize_to_list_of_substitutions(subs: SomeSubstitutionsType) -> list[Substitution]:
    """Whatever stands for a text, as a list of substitutions. Raises TypeError."""
    from launch.substitutions import TextSubstitution  # which needs this module

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
    """The text that a list of substitutions makes."""
    return "".join(context.perform_substitution(sub) for sub in subs)


def described(subs: Iterable[Substitution]) -> str:
    """A text for people on a list of substitutions."""
    return " + ".join(sub.describe() for sub in subs)


def text_of(context: LaunchContext, subs: SomeSubstitutionsType) -> str:
    """The text that anything makes that may stand for one."""
    return perform_substitutions(context, normalize_to_list_of_substitutions(subs))


def value_of(context: LaunchContext, value: Any, kind: type) -> Any:
    """A value of this type, given as such or as a text of YAML. Raises ValueError for a text of another."""
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
    """Raise TypeError if an argument is of none of these types."""
    kinds = tuple(types) if isinstance(types, Iterable) else (types,)
    if not isinstance(argument, kinds):
        begin = "E" if caller is None else f"'{caller}' e"
        expected = ", ".join(map(str, kinds))
        raise TypeError(
            f"{begin}xpected '{argument_name}' to be one of [{expected}], "
            f"but got '{argument}' of type '{type(argument)}'"
        )
