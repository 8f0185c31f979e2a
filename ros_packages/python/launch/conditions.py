"""The conditions on which an action is executed."""

from __future__ import annotations

import warnings

from launch.condition import Condition
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions, text_of

__all__ = [
    "IfCondition",
    "InvalidConditionExpressionError",
    "LaunchConfigurationEquals",
    "LaunchConfigurationNotEquals",
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


class LaunchConfigurationEquals(Condition):
    """The action is executed if a launch configuration has this value; None: if it isn't set. Deprecated."""

    def __init__(self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None) -> None:
        super().__init__(predicate=self._holds)
        self.__name, self.__expected = launch_configuration_name, expected_value
        text = f"{type(self).__name__} is deprecated. Use IfCondition with an EqualsSubstitution or a "
        warnings.warn(f"{text}NotEqualsSubstitution instead.", stacklevel=2)

    def _holds(self, context: LaunchContext) -> bool:
        expected = None if self.__expected is None else text_of(context, self.__expected)
        return context.launch_configurations.get(self.__name) == expected


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """The action is executed if a launch configuration has another value; None: if it is set. Deprecated."""

    def _holds(self, context: LaunchContext) -> bool:
        return not super()._holds(context)
