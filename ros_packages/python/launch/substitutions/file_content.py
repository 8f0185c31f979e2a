"""The substitution `FileContent`."""

from __future__ import annotations

from pathlib import Path

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.utilities import (
    describe_substitutions,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)


class FileContent(Substitution):
    """The text in a file."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self.__path = normalize_to_list_of_substitutions(path)

    @property
    def path(self) -> list[Substitution]:
        """The path of the file."""
        return self.__path

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"FileContent({describe_substitutions(self.path)})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        path = perform_substitutions(context, self.path)
        try:
            return Path(path).read_text(encoding="utf-8")
        except FileNotFoundError:
            raise SubstitutionFailure(f"File not found: {path}") from None
