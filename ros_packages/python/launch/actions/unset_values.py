"""The actions that remove launch configurations and environment variables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions, text_of


class _UnsetValue(Action):
    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name


class UnsetLaunchConfiguration(_UnsetValue):
    """Removes a launch configuration, if it is set."""

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        context.launch_configurations.pop(perform_substitutions(context, self.name), None)


class UnsetEnvironmentVariable(_UnsetValue):
    """Removes an environment variable, if it is set, for the processes that are started after it."""

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        context.environment.pop(perform_substitutions(context, self.name), None)


class ResetEnvironment(Action):
    """Gives the processes that are started after it the environment from before the first action."""

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        context._reset_environment()


class ResetLaunchConfigurations(Action):
    """Removes all launch configurations. launch_configurations: those that are set instead."""

    def __init__(
        self, launch_configurations: Mapping[Any, SomeSubstitutionsType] | None = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.__configurations = dict(launch_configurations or {})

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        given = self.__configurations.items()
        kept = {text_of(context, name): text_of(context, value) for name, value in given}
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)
