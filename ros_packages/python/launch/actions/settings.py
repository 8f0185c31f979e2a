"""Actions that set what others look up, or say something."""

from __future__ import annotations

from typing import Any

from launch.entities import Action, SomeSubstitutionsType, Substitution
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


class DeclareLaunchArgument(Action):
    """An argument that the launch file takes, as `NAME:=VALUE`. Without a default it must be given."""

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
        """Its name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """Its value where none is given."""
        return self.__default

    @property
    def description(self) -> str:
        """What it is for."""
        return self.__description

    @property
    def choices(self) -> list[str] | None:
        """The values that it may have."""
        return self.__choices

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
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


class _Setting(Action):
    """A name gets a value."""

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

    def _set(self, context: LaunchContext, known: dict[str, Any]) -> None:
        known[perform_substitutions(context, self.name)] = perform_substitutions(context, self.value)


class SetLaunchConfiguration(_Setting):
    """A launch configuration gets a value."""

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        self._set(context, context.launch_configurations)


class SetEnvironmentVariable(_Setting):
    """An environment variable gets a value, for the programs that are started from here on."""

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        self._set(context, context.environment)


class LogInfo(Action):
    """Says something."""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__msg = normalize_to_list_of_substitutions(msg)

    @property
    def msg(self) -> list[Substitution]:
        """What it says."""
        return self.__msg

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        get_logger("launch.user").info(perform_substitutions(context, self.msg))
