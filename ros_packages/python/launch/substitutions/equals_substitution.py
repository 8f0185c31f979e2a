"""The substitutions `EqualsSubstitution` and `NotEqualsSubstitution`."""

from __future__ import annotations

import math
from typing import Any

from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


def _parse_bool(text: str) -> bool | None:
    return {"true": True, "1": True, "false": False, "0": False}.get(text.lower())


def _parse_float(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _operand(value: Any) -> list[Substitution]:
    if isinstance(value, bool):
        value = str(value).lower()
    elif not isinstance(value, Substitution | list | tuple):
        value = "" if value is None else str(value)
    return normalize_to_list_of_substitutions(value)


class EqualsSubstitution(Substitution):
    """ "true" if both sides are the same text, number or boolean, else "false"."""

    def __init__(self, left: Any, right: Any) -> None:
        self.__left, self.__right = _operand(left), _operand(right)

    @property
    def left(self) -> list[Substitution]:
        """The left side."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """The right side."""
        return self.__right

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"{type(self).__name__}({self.left} {self.right})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        left, right = (perform_substitutions(context, side) for side in (self.left, self.right))
        if _parse_bool(left) is not None and _parse_bool(right) is not None:
            return str(_parse_bool(left) == _parse_bool(right)).lower()
        if _parse_float(left) is not None and _parse_float(right) is not None:
            return str(math.isclose(_parse_float(left), _parse_float(right))).lower()
        return str(left == right).lower()


class NotEqualsSubstitution(EqualsSubstitution):
    """ "false" if `EqualsSubstitution` is "true", else "true"."""

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return "false" if super().perform(context) == "true" else "true"
