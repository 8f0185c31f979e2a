"""Whether two texts are equal, as a text."""

from __future__ import annotations

import math
from typing import Any

from launch.entities import Substitution
from launch.launch_context import LaunchContext
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


def _truth(text: str) -> bool | None:
    return {"true": True, "1": True, "false": False, "0": False}.get(text.lower())


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _side(value: Any) -> list[Substitution]:
    if isinstance(value, bool):
        value = str(value).lower()
    elif not isinstance(value, Substitution | list | tuple):
        value = "" if value is None else str(value)
    return normalize_to_list_of_substitutions(value)


class EqualsSubstitution(Substitution):
    """ "true" where both sides are the same text, number or truth, else "false"."""

    def __init__(self, left: Any, right: Any) -> None:
        self.__left, self.__right = _side(left), _side(right)

    @property
    def left(self) -> list[Substitution]:
        """One side."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """The other side."""
        return self.__right

    def describe(self) -> str:
        """As `Substitution`."""
        return f"{type(self).__name__}({self.left} {self.right})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        left, right = (perform_substitutions(context, side) for side in (self.left, self.right))
        if _truth(left) is not None and _truth(right) is not None:
            return str(_truth(left) == _truth(right)).lower()
        if _number(left) is not None and _number(right) is not None:
            return str(math.isclose(_number(left), _number(right))).lower()
        return str(left == right).lower()


class NotEqualsSubstitution(EqualsSubstitution):
    """ "false" where `EqualsSubstitution` is "true", and the other way round."""

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`."""
        return "false" if super().perform(context) == "true" else "true"
