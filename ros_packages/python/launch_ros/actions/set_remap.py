"""The action `SetRemap`."""

from __future__ import annotations

from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, text_of

REMAPPINGS = "ros_remaps"  # the launch configuration that all nodes read


class SetRemap(Action):
    """Remaps a name of all later nodes of its group, before their own remappings."""

    def __init__(self, src: SomeSubstitutionsType, dst: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__src = normalize_to_list_of_substitutions(src)
        self.__dst = normalize_to_list_of_substitutions(dst)

    @property
    def src(self) -> list[Substitution]:
        """The name in the code."""
        return self.__src

    @property
    def dst(self) -> list[Substitution]:
        """The name that replaces it."""
        return self.__dst

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        remappings = context.launch_configurations.setdefault(REMAPPINGS, [])
        remappings.append((text_of(context, self.__src), text_of(context, self.__dst)))
