"""The substitution `LocalSubstitution`."""

from __future__ import annotations

from launch.launch_context import LaunchContext
from launch.substitution import Substitution
from launch.utilities import ensure_argument_type


class LocalSubstitution(Substitution):
    """A local name of the context, for example "event.reason" in an event handler."""

    def __init__(self, expression: str) -> None:
        ensure_argument_type(expression, str, "expression", "LocalSubstitution")
        self.__expression = expression

    @property
    def expression(self) -> str:
        """The name, with its attributes."""
        return self.__expression

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        return eval(f"known.{self.expression}", {}, {"known": context.locals})
