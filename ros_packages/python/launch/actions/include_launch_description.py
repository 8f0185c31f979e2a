"""The action `IncludeLaunchDescription`."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.actions.set_values import SetLaunchConfiguration
from launch.launch_context import LaunchContext
from launch.launch_description import LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity, as_list
from launch.launch_description_sources import AnyLaunchDescriptionSource, LaunchDescriptionSource
from launch.substitution import SomeSubstitutionsType
from launch.utilities import text_of


class IncludeLaunchDescription(Action):
    """Executes another launch file. What that file sets remains set, unless the action is in a group."""

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
        """The source of the included description."""
        return self.__source

    @property
    def launch_arguments(self) -> tuple[tuple[SomeSubstitutionsType, SomeSubstitutionsType], ...]:
        """The arguments for the included file."""
        return self.__arguments

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Work like `Action`."""
        return as_list(self.__source.try_get_launch_description_without_context())

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Work like `Action`."""
        description = self.__source.get_launch_description(context)
        before = context.get_locals_as_dict()
        path = os.path.abspath(self.__source.location)
        folder = os.path.dirname(path) if os.path.exists(path) else self.__source.location
        here = {"current_launch_file_path": path, "current_launch_file_directory": folder}
        context.extend_locals(here)
        self.__check_arguments(description, [text_of(context, name) for name, _ in self.__arguments])
        restored = {name: before[name] for name in here if name in before}
        return [
            *(SetLaunchConfiguration(name, value) for name, value in self.__arguments),
            description,
            OpaqueFunction(function=lambda context: context.extend_locals(restored)),
        ]

    @staticmethod
    def __check_arguments(description: LaunchDescription, given: list[str]) -> None:
        for argument in description._arguments(outside=IncludeLaunchDescription):
            if (
                not argument._conditionally_included
                and argument.default_value is None
                and argument.name not in given
            ):
                raise RuntimeError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(given)}]"
                )
