"""The base class of substitutions, and the substitution that plain text becomes."""

from __future__ import annotations

from collections.abc import Iterable

from launch.launch_context import LaunchContext


class Substitution:
    """A text that is known only when the launch file is executed."""

    def describe(self) -> str:
        """A description for people."""
        return repr(self)

    def perform(self, context: LaunchContext) -> str:
        """The text that it is replaced by."""
        return ""


SomeSubstitutionsType = str | Substitution | Iterable[str | Substitution]


class SubstitutionFailure(RuntimeError):
    """A substitution can't be replaced by a text."""


class TextSubstitution(Substitution):
    """A text that is used as it is."""

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise TypeError(f"TextSubstitution expected Text object got '{type(text)}' instead.")
        self.__text = text

    @property
    def text(self) -> str:
        """The text."""
        return self.__text

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return self.text
