"""The conditions on which an action is executed."""

from __future__ import annotations

from typing import NoReturn

from launch.condition import Condition
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.unsupported import refuse
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

__all__ = [
    "IfCondition",
    "InvalidConditionExpressionError",
    "UnlessCondition",
    "evaluate_condition_expression",
]


class InvalidConditionExpressionError(ValueError):
    """A text is neither true nor false."""

    def __init__(self, expression: str, unexpanded_expression: list, valid_expressions: list[str]) -> None:
        super().__init__(
            f"invalid condition expression, expected one of [{', '.join(valid_expressions)}] "
            f"but got '{expression}', expanded from '{' + '.join(map(str, unexpanded_expression))}'"
        )


def evaluate_condition_expression(context: LaunchContext, expression: list[Substitution]) -> bool:
    """Return whether a text is true or 1. Raises InvalidConditionExpressionError unless it is false or 0."""
    valid = {"true": True, "1": True, "false": False, "0": False}
    text = perform_substitutions(context, expression).strip().lower()
    if text not in valid:
        raise InvalidConditionExpressionError(text, expression, list(valid))
    return valid[text]


class IfCondition(Condition):
    """The action is executed if the text is true or 1."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=lambda context: evaluate_condition_expression(context, expression))


class UnlessCondition(Condition):
    """The action is executed if the text is false or 0."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=lambda context: not evaluate_condition_expression(context, expression))


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
