"""The actions `SetLaunchConfiguration` and `SetEnvironmentVariable`."""

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

    def _set_in(self, values: dict[str, Any], context: LaunchContext) -> None:
        values[perform_substitutions(context, self.name)] = perform_substitutions(context, self.value)


class SetLaunchConfiguration(_SetValue):
    """Sets a launch configuration."""

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        self._set_in(context.launch_configurations, context)


class SetEnvironmentVariable(_SetValue):
    """Sets an environment variable for the processes that are started after it."""

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        self._set_in(context.environment, context)
