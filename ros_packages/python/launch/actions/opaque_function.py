"""The action `OpaqueFunction`."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from launch.action import Action
from launch.launch_context import LaunchContext
from launch.utilities import ensure_argument_type


class OpaqueFunction(Action):
    """Calls a function with the context and these arguments. The function may return entities to visit."""

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
        """Work like `Action`."""
        return self.__function(context, *self.__args, **self.__kwargs)
