"""Actions that bring in others: at once, later, or when something happens."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import Any

from launch.actions.settings import SetLaunchConfiguration
from launch.entities import (
    Action,
    LaunchDescriptionEntity,
    SomeSubstitutionsType,
    as_list,
)
from launch.launch_context import LaunchContext
from launch.launch_description_sources import AnyLaunchDescriptionSource, LaunchDescriptionSource
from launch.utilities import ensure_argument_type, text_of


class OpaqueFunction(Action):
    """A function of the context and these arguments, which may return further entities."""

    def __init__(
        self,
        *,
        function: Callable[..., Any],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            raise TypeError(f"OpaqueFunction expected a callable for 'function', got '{type(function)}'")
        ensure_argument_type(args, (Iterable, type(None)), "args", "OpaqueFunction")
        ensure_argument_type(kwargs, (dict, type(None)), "kwargs", "OpaqueFunction")
        self.__function, self.__args, self.__kwargs = function, list(args or ()), dict(kwargs or {})

    def execute(self, context: LaunchContext) -> Any:
        """As `Action`."""
        return self.__function(context, *self.__args, **self.__kwargs)


class GroupAction(Action):
    """Actions that belong together.

    scoped: what they set is forgotten after them. forwarding: they see what was set before.
    launch_configurations: set for them.
    """

    def __init__(
        self,
        actions: Iterable[Action],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: dict[Any, SomeSubstitutionsType] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        self.__actions, self.__scoped, self.__forwarding = list(actions), scoped, forwarding
        self.__configurations = dict(launch_configurations or {})

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """As `Action`."""
        return self.__actions

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """As `Action`."""
        settings = [SetLaunchConfiguration(name, value) for name, value in self.__configurations.items()]
        if not self.__scoped:
            return [*settings, *self.__actions]
        return [
            OpaqueFunction(function=self.__begin),
            *settings,
            *self.__actions,
            OpaqueFunction(function=lambda context: context._pop_scope()),
        ]

    def __begin(self, context: LaunchContext) -> None:
        context._push_scope()
        if not self.__forwarding:
            context._reset_scope({})


class IncludeLaunchDescription(Action):
    """Another launch file. What it sets stays set, unless it stands in a group."""

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType,
        *,
        launch_arguments: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self.__source = launch_description_source
        self.__arguments = tuple(launch_arguments or ())

    @property
    def launch_description_source(self) -> LaunchDescriptionSource:
        """Where the file is."""
        return self.__source

    @property
    def launch_arguments(self) -> tuple[tuple[SomeSubstitutionsType, SomeSubstitutionsType], ...]:
        """The arguments that it is given."""
        return self.__arguments

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """As `Action`."""
        return as_list(self.__source.try_get_launch_description_without_context())

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """As `Action`."""
        description = self.__source.get_launch_description(context)
        before = context.get_locals_as_dict()
        path = os.path.abspath(self.__source.location)
        folder = os.path.dirname(path) if os.path.exists(path) else self.__source.location
        here = {"current_launch_file_path": path, "current_launch_file_directory": folder}
        context.extend_locals(here)
        given = [text_of(context, name) for name, _ in self.__arguments]
        for argument in description._own_arguments():
            if (
                not argument._conditionally_included
                and argument.default_value is None
                and argument.name not in given
            ):
                raise RuntimeError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(given)}]"
                )
        back = {name: before[name] for name in here if name in before}
        return [
            *(SetLaunchConfiguration(name, value) for name, value in self.__arguments),
            description,
            OpaqueFunction(function=lambda context: context.extend_locals(back)),
        ]
