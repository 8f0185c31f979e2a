"""The action `DeclareLaunchArgument`."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


class DeclareLaunchArgument(Action):
    """Declares an argument of the launch file, given as NAME:=VALUE. Without a default it is required."""

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: list[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__name, self.__choices = name, choices
        self.__default = None if default_value is None else normalize_to_list_of_substitutions(default_value)
        if choices is not None:
            self.__check(default_value, choices)
        if description is None:
            self.__description = "no description given" if choices is None else f"One of: {choices}"
        elif choices is None:
            self.__description = description
        else:
            self.__description = f"{description.removesuffix('.')}. Valid choices are: {choices}"
        self._conditionally_included = False

    @staticmethod
    def __check(default: Any, choices: list[str]) -> None:
        if not choices:
            raise RuntimeError("Provided choices arg is empty. Use None to ignore the choice list.")
        if isinstance(default, str) and default not in choices:
            raise RuntimeError(f'Provided default_value "{default}" is not in provided choices "{choices}".')

    @property
    def name(self) -> str:
        """The name of the argument."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value that is used if none is given."""
        return self.__default

    @property
    def description(self) -> str:
        """Return what the argument is for."""
        return self.__description

    @property
    def choices(self) -> list[str] | None:
        """The values that are allowed; None allows any."""
        return self.__choices

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        known = context.launch_configurations
        if self.name not in known:
            if self.__default is None:
                get_logger("launch.actions.declare_launch_argument").error(
                    f'Required launch argument "{self.name}" (description: "{self.description}") '
                    "was not provided"
                )
                raise RuntimeError(f'Required launch argument "{self.name}" was not provided.')
            known[self.name] = perform_substitutions(context, self.__default)
        if self.__choices is not None and known[self.name] not in self.__choices:
            text = f'Argument "{self.name}" provided value "{known[self.name]}" is not valid.'
            text += f" Valid options are: {self.__choices}"
            get_logger("launch.actions.declare_launch_argument").error(text)
            raise RuntimeError(text)
