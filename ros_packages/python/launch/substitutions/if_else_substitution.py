"""The substitution `IfElseSubstitution`."""

from __future__ import annotations

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions, value_of


class IfElseSubstitution(Substitution):
    """One of two texts: the first if the condition is true, in YAML's sense, else the second."""

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:
        if if_value == else_value == "":
            raise RuntimeError("One of if_value and else_value must be specified")
        self.__condition = normalize_to_list_of_substitutions(condition)
        self.__if_value = normalize_to_list_of_substitutions(if_value)
        self.__else_value = normalize_to_list_of_substitutions(else_value)

    @property
    def condition(self) -> list[Substitution]:
        """The condition."""
        return self.__condition

    @property
    def if_value(self) -> list[Substitution]:
        """The text if the condition is true."""
        return self.__if_value

    @property
    def else_value(self) -> list[Substitution]:
        """The text if it is false."""
        return self.__else_value

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"IfElseSubstitution({self.condition}, {self.if_value}, {self.else_value})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        try:
            is_true = value_of(context, self.condition, bool)
        except (TypeError, ValueError) as error:
            raise SubstitutionFailure(error) from None
        return perform_substitutions(context, self.if_value if is_true else self.else_value)
