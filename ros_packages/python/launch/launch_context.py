"""The state of a launch file that is being executed: configurations, environment, events, handlers."""

from __future__ import annotations

import asyncio
import contextlib
import os
from collections import deque
from collections.abc import Callable, Iterable
from itertools import count
from types import SimpleNamespace
from typing import Any, Protocol

from launch_process_starters import provided_starter

from launch.event import Event
from launch.processes import ProcessStarter, SystemProcessStarter


class _Substitution(Protocol):
    """What the context uses of a `launch.Substitution`."""

    def perform(self, context: LaunchContext) -> str:
        """The text that it is replaced by."""


class _EventHandler(Protocol):
    """What the context uses of a `launch.BaseEventHandler`."""

    def matches(self, event: Event) -> bool:
        """Return whether it handles the event."""


class _Locals(SimpleNamespace):
    def __getattr__(self, name: str) -> Any:
        known = ", ".join(vars(self))
        raise AttributeError(f"context.locals does not contain attribute '{name}', it contains: [{known}]")


class LaunchContext:
    """The state of one launch file that is being executed.

    `environment` is what its processes get. It is a copy, so this process's own environment never changes.
    """

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False) -> None:
        self.argv, self.noninteractive = list(argv or ()), noninteractive
        self.launch_configurations: dict[str, Any] = {}
        self.environment = dict(os.environ)
        self.is_shutdown = False
        self.asyncio_loop: asyncio.AbstractEventLoop | None = None
        self.process_starter: ProcessStarter = provided_starter() or SystemProcessStarter()
        self.process_numbers = count(1)  # the suffixes of the processes' names
        self._globals: dict[str, Any] = {}
        self._locals: dict[str, Any] = {}
        self._locals_stack: list[dict[str, Any]] = []
        self._configurations_stack: list[dict[str, Any]] = []
        self._environment_stack: list[dict[str, str]] = []
        self._initial_environment = dict(self.environment)
        self._handlers: deque[_EventHandler] = deque()
        self._events: deque[Event] = deque()
        self._wake = asyncio.Event()
        self._at_end = contextlib.ExitStack()

    # -- events --------------------------------------------------------------------------------------

    def register_event_handler(self, event_handler: _EventHandler, append: bool = False) -> None:
        """Add a handler before all others, or with `append` after them."""
        if append:
            self._handlers.append(event_handler)
        else:
            self._handlers.appendleft(event_handler)

    def unregister_event_handler(self, event_handler: _EventHandler) -> None:
        """Remove a handler. Raises ValueError if it isn't registered."""
        self._handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """Return whether any handler is registered for the event."""
        return any(handler.matches(event) for handler in self._handlers)

    def emit_event_sync(self, event: Event) -> None:
        """Queue an event; the launch service calls its handlers later."""
        self._events.append(event)
        self._wake.set()

    async def emit_event(self, event: Event) -> None:
        """Work like `emit_event_sync`."""
        self.emit_event_sync(event)

    def call_at_end(self, function: Callable[[], None]) -> None:
        """Call a function when the launch service ends, after everything that was launched is complete."""
        self._at_end.callback(function)

    # -- names and their values ----------------------------------------------------------------------

    def extend_globals(self, extensions: dict[str, Any]) -> None:
        """Add names that are defined everywhere."""
        self._globals.update(extensions)

    def extend_locals(self, extensions: dict[str, Any]) -> None:
        """Add names that are defined until the current event has been handled."""
        self._locals.update(extensions)

    def get_locals_as_dict(self) -> dict[str, Any]:
        """All global and local names with their values."""
        return {**self._globals, **self._locals}

    @property
    def locals(self) -> Any:
        """All global and local names, as attributes."""
        return _Locals(**self.get_locals_as_dict())

    def perform_substitution(self, substitution: _Substitution) -> str:
        """The text that a substitution is replaced by in this context."""
        return substitution.perform(self)

    # -- scopes --------------------------------------------------------------------------------------

    def replace_environment(self, environment: dict[str, str]) -> None:
        """Give processes this environment instead of this process's own. Call it before the first action."""
        self.environment, self._initial_environment = dict(environment), dict(environment)

    def _push_locals(self) -> None:
        self._locals_stack.append(dict(self._locals))

    def _pop_locals(self) -> None:
        self._locals = self._locals_stack.pop()

    def _push_scope(self) -> None:
        # Lists are copied, because the parameters for all nodes are appended in place.
        copy = {name: list(v) if isinstance(v, list) else v for name, v in self.launch_configurations.items()}
        self._configurations_stack.append(self.launch_configurations)
        self._environment_stack.append(self.environment)
        self.launch_configurations, self.environment = copy, dict(self.environment)

    def _pop_scope(self) -> None:
        self.launch_configurations = self._configurations_stack.pop()
        self.environment = self._environment_stack.pop()

    def _reset_scope(self) -> None:
        self.launch_configurations = {}
        self.environment = dict(self._initial_environment)
