"""The actions that set launch configurations and environment variables."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


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
