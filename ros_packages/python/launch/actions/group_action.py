"""The action `GroupAction`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.actions.set_values import SetLaunchConfiguration
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType


class GroupAction(Action):
    """Executes several actions.

    scoped: what they set is restored after them. forwarding: they see what was set before.
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
        """Work like `Action`."""
        return self.__actions

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Work like `Action`."""
        settings = [SetLaunchConfiguration(name, value) for name, value in self.__configurations.items()]
        if not self.__scoped:
            return [*settings, *self.__actions]
        return [
            OpaqueFunction(function=self.__enter_scope),
            *settings,
            *self.__actions,
            OpaqueFunction(function=lambda context: context._pop_scope()),
        ]

    def __enter_scope(self, context: LaunchContext) -> None:
        context._push_scope()
        if not self.__forwarding:
            context._reset_scope()
