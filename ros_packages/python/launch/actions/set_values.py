"""The actions that set launch configurations and environment variables."""

from __future__ import annotations

import os
from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions, value_of


class _SetValue(Action):
    def __init__(self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)
        self.__value = normalize_to_list_of_substitutions(value)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value

    def _performed(self, context: LaunchContext) -> tuple[str, str]:
        return perform_substitutions(context, self.name), perform_substitutions(context, self.value)


class SetLaunchConfiguration(_SetValue):
    """Sets a launch configuration."""

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        name, value = self._performed(context)
        context.launch_configurations[name] = value


class SetEnvironmentVariable(_SetValue):
    """Sets an environment variable for the processes that are started after it."""

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        name, value = self._performed(context)
        context.environment[name] = value


class AppendEnvironmentVariable(_SetValue):
    """Adds a value to an environment variable for the processes that are started after it.

    A variable that isn't set gets the value alone. prepend: the new value comes first. separator: between the
    two values.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(name, value, **kwargs)
        self.__prepend = prepend
        self.__separator = normalize_to_list_of_substitutions(separator)

    @property
    def prepend(self) -> Any:
        """Return whether the value comes first."""
        return self.__prepend

    @property
    def separator(self) -> list[Substitution]:
        """Return what is between the two values."""
        return self.__separator

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        name, value = self._performed(context)
        parts = [context.environment[name], value] if name in context.environment else [value]
        if value_of(context, self.__prepend, bool):
            parts.reverse()
        context.environment[name] = perform_substitutions(context, self.__separator).join(parts)
