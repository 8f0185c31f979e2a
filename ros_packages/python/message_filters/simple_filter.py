"""What all filters have in common: callbacks that are called with each output."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class SimpleFilter:
    """A filter calls its callbacks, in the order in which they were registered."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:
        """Call `cb` with each output, followed by `args`. Returns the connection's number."""
        connection = len(self.callbacks)
        self.callbacks[connection] = (cb, args)
        return connection

    def signalMessage(self, *msg: Any) -> None:
        """Call all callbacks with these messages."""
        for callback, arguments in self.callbacks.values():
            callback(*msg, *arguments)
