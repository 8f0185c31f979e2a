"""The substitution `PathJoinSubstitution`."""

from __future__ import annotations

import os
from collections.abc import Iterable

from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.utilities import describe_substitutions, normalize_to_list_of_substitutions


class PathJoinSubstitution(Substitution):
    """The parts of a path, joined."""

    def __init__(self, substitutions: Iterable[str | Substitution]) -> None:
        self.__substitutions = normalize_to_list_of_substitutions(substitutions)

    @property
    def substitutions(self) -> list[Substitution]:
        """The parts."""
        return self.__substitutions

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"PathJoin('{describe_substitutions(self.substitutions)}')"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return os.path.join(*(sub.perform(context) for sub in self.__substitutions))
