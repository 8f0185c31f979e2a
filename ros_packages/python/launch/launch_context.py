"""What a launch file under way knows: its configurations, its environment, its events and their handlers."""

from __future__ import annotations

import asyncio
import os
from collections import deque
from collections.abc import Iterable
from itertools import count
from types import SimpleNamespace
from typing import Any

from launch.entities import BaseEventHandler, Event, Substitution
from launch.processes import Processes, RealProcesses


class _Locals(SimpleNamespace):
    def __getattr__(self, name: str) -> Any:
        known = ", ".join(vars(self))
        raise AttributeError(f"context.locals does not contain attribute '{name}', it contains: [{known}]")


class LaunchContext:
    """The state of one launch file under way.

    `environment` is what the programs get: a copy, so that this process's own stays what it is.
    """

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False) -> None:
        self.argv, self.noninteractive = list(argv or ()), noninteractive
        self.launch_configurations: dict[str, Any] = {}
        self.environment = dict(os.environ)
        self.is_shutdown = False
        self.asyncio_loop: asyncio.AbstractEventLoop | None = None
        self.processes: Processes = RealProcesses()
        self.numbers = count(1)  # of its processes, for their names
        self._globals: dict[str, Any] = {}
        self._locals: dict[str, Any] = {}
        self._locals_stack: list[dict[str, Any]] = []
        self._configurations_stack: list[dict[str, Any]] = []
        self._environment_stack: list[dict[str, str]] = []
        self._first_environment = dict(self.environment)
        self._handlers: deque[BaseEventHandler] = deque()
        self._events: deque[Event] = deque()
        self._wake = asyncio.Event()

    # -- events --------------------------------------------------------------------------------------

    def register_event_handler(self, event_handler: BaseEventHandler, append: bool = False) -> None:
        """Add a handler before all others, or with `append` after them."""
        if append:
            self._handlers.append(event_handler)
        else:
            self._handlers.appendleft(event_handler)

    def unregister_event_handler(self, event_handler: BaseEventHandler) -> None:
        """Take a handler away. Raises ValueError where it isn't there."""
        self._handlers.remove(event_handler)

    def would_handle_event(self, event: Event) -> bool:
        """Whether there is a handler for it."""
        return any(handler.matches(event) for handler in self._handlers)

    def emit_event_sync(self, event: Event) -> None:
        """Tell of an event; its handlers are asked soon."""
        self._events.append(event)
        self._wake.set()

    async def emit_event(self, event: Event) -> None:
        """As `emit_event_sync`."""
        self.emit_event_sync(event)

    # -- what is known by name -----------------------------------------------------------------------

    def extend_globals(self, extensions: dict[str, Any]) -> None:
        """Add names that are known everywhere."""
        self._globals.update(extensions)

    def extend_locals(self, extensions: dict[str, Any]) -> None:
        """Add names that are known until the event at hand is done with."""
        self._locals.update(extensions)

    def get_locals_as_dict(self) -> dict[str, Any]:
        """All names that are known here."""
        return {**self._globals, **self._locals}

    @property
    def locals(self) -> Any:
        """All names that are known here, as attributes."""
        return _Locals(**self.get_locals_as_dict())

    def perform_substitution(self, substitution: Substitution) -> str:
        """What a substitution makes here."""
        return substitution.perform(self)

    # -- scopes --------------------------------------------------------------------------------------

    def begin_with(self, environment: dict[str, str]) -> None:
        """Let programs get this environment, and not that of this process. Call it before all else."""
        self.environment, self._first_environment = dict(environment), dict(environment)

    def _push_locals(self) -> None:
        self._locals_stack.append(dict(self._locals))

    def _pop_locals(self) -> None:
        self._locals = self._locals_stack.pop()

    def _push_scope(self) -> None:
        # Lists in it grow in place, as those of parameters and remappings for all nodes.
        copy = {name: list(v) if isinstance(v, list) else v for name, v in self.launch_configurations.items()}
        self._configurations_stack.append(self.launch_configurations)
        self._environment_stack.append(self.environment)
        self.launch_configurations, self.environment = copy, dict(self.environment)

    def _pop_scope(self) -> None:
        self.launch_configurations = self._configurations_stack.pop()
        self.environment = self._environment_stack.pop()

    def _reset_scope(self, kept: dict[str, Any]) -> None:
        self.launch_configurations, self.environment = dict(kept), dict(self._first_environment)
