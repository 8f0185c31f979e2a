"""The substitution `FindExecutable`."""

from __future__ import annotations

import shutil
import sys

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import (
    describe_substitutions,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)


class FindExecutable(Substitution):
    """The path of an executable on PATH, or else in this Python's environment, even if it isn't activated."""

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """The name of the executable."""
        return self.__name

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"FindExec({describe_substitutions(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        name = perform_substitutions(context, self.name)
        path = shutil.which(name) or shutil.which(name, path=f"{sys.prefix}/bin")
        if path is None:
            raise SubstitutionFailure(f"executable '{name}' not found on the PATH")
        return path
