"""The substitution `LaunchConfiguration`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import (
    describe_substitutions,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)


class LaunchConfiguration(Substitution):
    """The value of a launch configuration, for example of a launch argument."""

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any = None) -> None:
        self.__name = normalize_to_list_of_substitutions(variable_name)
        self.__default = None
        if default is not None:
            parts = default if isinstance(default, Iterable) and not isinstance(default, str) else [default]
            texts = [part if isinstance(part, str | Substitution) else str(part) for part in parts]
            self.__default = normalize_to_list_of_substitutions(texts)

    @property
    def variable_name(self) -> list[Substitution]:
        """The name of the configuration."""
        return self.__name

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"LaunchConfig({describe_substitutions(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        name = perform_substitutions(context, self.__name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self.__default is None:
            raise SubstitutionFailure(f"launch configuration '{name}' does not exist")
        return perform_substitutions(context, self.__default)
