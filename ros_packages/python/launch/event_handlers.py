"""The event handlers that launch files use."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NoReturn

from launch.action import Action
from launch.actions.execute_process import ExecuteProcess
from launch.event import Event
from launch.event_handler import BaseEventHandler, EventHandler, OnActionEventBase
from launch.events import ExecutionComplete, Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity, as_list
from launch.unsupported import refuse

__all__ = [
    "OnExecutionComplete",
    "OnProcessExit",
    "OnProcessIO",
    "OnProcessStart",
    "OnShutdown",
]


class OnProcessStart(OnActionEventBase):
    """Visits entities when a process was started.

    on_start: the entities, or a function (event, context) -> entities.
    """

    def __init__(self, *, target_action: Any = None, on_start: Any, **kwargs: Any) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )


class OnProcessExit(OnActionEventBase):
    """Visits entities when a process has exited.

    on_exit: the entities, or a function (event, context) -> entities.
    """

    def __init__(self, *, target_action: Any = None, on_exit: Any, **kwargs: Any) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )


class OnProcessIO(OnActionEventBase):
    """Calls a function with the event when a process has written a line. It may return entities."""

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: Callable[[ProcessIO], Any] | None = None,
        on_stdout: Callable[[ProcessIO], Any] | None = None,
        on_stderr: Callable[[ProcessIO], Any] | None = None,
        **kwargs: Any,
    ) -> None:
        def on_io(event: ProcessIO, _: LaunchContext) -> Any:
            callback = on_stdout if event.from_stdout else on_stderr if event.from_stderr else on_stdin
            return None if callback is None else callback(event)

        super().__init__(
            action_matcher=target_action,
            on_event=on_io,
            target_event_cls=ProcessIO,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )


class OnExecutionComplete(EventHandler):
    """Visits entities when an action is complete.

    on_completion: the entities, or a function (event, context) -> entities.
    """

    def __init__(self, *, target_action: Action | None = None, on_completion: Any, **kwargs: Any) -> None:
        if not isinstance(target_action, Action | None):
            raise ValueError("OnExecutionComplete requires an 'Action' as the target")
        self.__on_completion = on_completion if callable(on_completion) else as_list(on_completion)
        for entity in [] if callable(on_completion) else self.__on_completion:
            if not isinstance(entity, LaunchDescriptionEntity):
                raise ValueError(
                    "expected all items in 'on_completion' iterable to be of type 'LaunchDescriptionEntity' "
                    f"but got '{type(entity)}'"
                )

        def matches(event: Event) -> bool:
            return isinstance(event, ExecutionComplete) and target_action in (None, event.action)

        super().__init__(matcher=matches, **kwargs)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Work like `BaseEventHandler`."""
        return super().describe()[0], [] if callable(self.__on_completion) else self.__on_completion

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Work like `BaseEventHandler`."""
        super().handle(event, context)
        callback = self.__on_completion
        return callback(event, context) if callable(callback) else callback


class OnShutdown(BaseEventHandler):
    """Visits entities on shutdown.

    on_shutdown: the entities, or a function (event, context) -> entities.
    """

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=lambda event: isinstance(event, Shutdown), **kwargs)
        self.__on_shutdown: Callable = on_shutdown if callable(on_shutdown) else lambda *_: on_shutdown

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Work like `BaseEventHandler`."""
        super().handle(event, context)
        return self.__on_shutdown(event, context)


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
