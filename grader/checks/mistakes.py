"""The likely wrong formula: a table of hints, each with what a node would do that made this mistake."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

Formula = TypeVar("Formula")


def usual_mistake(mistakes: Mapping[str, Formula], explains: Callable[[Formula], bool]) -> str:
    """The first hint whose formula explains what was seen, or "" where none does.

    mistakes: hint to formula, the likeliest first. explains: whether a formula gives all that the node said.
    """
    return next((hint for hint, formula in mistakes.items() if explains(formula)), "")
