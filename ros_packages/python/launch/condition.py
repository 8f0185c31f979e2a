"""The base class of conditions."""

from __future__ import annotations

from collections.abc import Callable

from launch.launch_context import LaunchContext


class Condition:
    """Decides whether an action is executed. `predicate` is called when the action is visited."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """A description for people."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether the condition holds; False if there is no predicate."""
        return self._predicate is not None and self._predicate(context)
