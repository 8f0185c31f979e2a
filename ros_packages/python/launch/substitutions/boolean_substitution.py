"""The substitutions that combine truth values: not, and, or, any, all."""

from __future__ import annotations

from collections.abc import Callable

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, value_of


class _BooleanSubstitution(Substitution):
    """ "true" or "false", made of texts that YAML reads so. Raises SubstitutionFailure for any other text."""

    def __init__(self, *args: SomeSubstitutionsType) -> None:
        self._operands = [normalize_to_list_of_substitutions(each) for each in args]

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"{type(self).__name__}({' '.join(map(str, self._operands))})"

    def _perform(self, context: LaunchContext, combine: Callable[[list[bool]], bool]) -> str:
        try:
            values = [value_of(context, each, bool) for each in self._operands]
        except (TypeError, ValueError) as error:
            raise SubstitutionFailure(error) from None
        return str(combine(values)).lower()


class NotSubstitution(_BooleanSubstitution):
    """ "true" if the value is false."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__(value)

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self._operands[0]

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return self._perform(context, lambda values: not values[0])


class AndSubstitution(_BooleanSubstitution):
    """ "true" if both sides are true."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__(left, right)

    @property
    def left(self) -> list[Substitution]:
        """The left side."""
        return self._operands[0]

    @property
    def right(self) -> list[Substitution]:
        """The right side."""
        return self._operands[1]

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return self._perform(context, all)


class OrSubstitution(AndSubstitution):
    """ "true" if one of the two sides is true, or both are."""

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return self._perform(context, any)


class AllSubstitution(_BooleanSubstitution):
    """ "true" if all values are true."""

    @property
    def args(self) -> list[list[Substitution]]:
        """The values."""
        return self._operands

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return self._perform(context, all)


class AnySubstitution(AllSubstitution):
    """ "true" if at least one of the values is true."""

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return self._perform(context, any)
