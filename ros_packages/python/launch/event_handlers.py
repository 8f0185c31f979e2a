"""What is done when something has happened."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NoReturn

from launch.entities import Action, BaseEventHandler, Event, EventHandler, LaunchDescriptionEntity, as_list
from launch.events import ExecutionComplete, Shutdown
from launch.events.process import ProcessExited, ProcessIO, ProcessStarted
from launch.launch_context import LaunchContext
from launch.unsupported import refuse

__all__ = [
    "OnExecutionComplete",
    "OnProcessExit",
    "OnProcessIO",
    "OnProcessStart",
    "OnShutdown",
]


class OnActionEventBase(BaseEventHandler):
    """A handler of one kind of event of one action, of those that a function is true of, or of all."""

    def __init__(
        self,
        *,
        action_matcher: Any,
        on_event: Any,
        target_event_cls: type,
        target_action_cls: type,
        **kwargs: Any,
    ) -> None:
        if not isinstance(action_matcher, target_action_cls | None) and not callable(action_matcher):
            raise TypeError(
                f"action_matcher must be an '{target_action_cls.__name__}' instance or a callable"
            )
        self.__on_event = on_event
        if not callable(on_event):
            for entity in on_event if isinstance(on_event, Iterable) else ():
                if not isinstance(entity, LaunchDescriptionEntity):
                    raise TypeError(
                        "expected all items in 'on_event' iterable to be of type 'LaunchDescriptionEntity' "
                        f"but got '{type(entity)}'"
                    )
            self.__on_event = as_list(on_event)

        def matches(event: Event) -> bool:
            if not isinstance(event, target_event_cls):
                return False
            if isinstance(action_matcher, target_action_cls):
                return event.action is action_matcher
            return action_matcher is None or bool(action_matcher(event.action))

        super().__init__(matcher=matches, **kwargs)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """As `BaseEventHandler`."""
        return super().describe()[0], [] if callable(self.__on_event) else list(self.__on_event)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """As `BaseEventHandler`."""
        super().handle(event, context)
        return self.__on_event(event, context) if callable(self.__on_event) else self.__on_event


class OnProcessStart(OnActionEventBase):
    """Entities for when a program was started, or a function (event, context) that gives them."""

    def __init__(self, *, target_action: Any = None, on_start: Any, **kwargs: Any) -> None:
        from launch.actions import ExecuteProcess  # which needs event handlers

        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )


class OnProcessExit(OnActionEventBase):
    """Entities for when a program has ended, or a function (event, context) that gives them."""

    def __init__(self, *, target_action: Any = None, on_exit: Any, **kwargs: Any) -> None:
        from launch.actions import ExecuteProcess  # which needs event handlers

        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )


class OnProcessIO(OnActionEventBase):
    """Functions of the event for when a program has written something; they may give entities."""

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: Callable[[ProcessIO], Any] | None = None,
        on_stdout: Callable[[ProcessIO], Any] | None = None,
        on_stderr: Callable[[ProcessIO], Any] | None = None,
        **kwargs: Any,
    ) -> None:
        from launch.actions import ExecuteProcess  # which needs event handlers

        def heard(event: ProcessIO, _: LaunchContext) -> Any:
            told = on_stdout if event.from_stdout else on_stderr if event.from_stderr else on_stdin
            return None if told is None else told(event)

        super().__init__(
            action_matcher=target_action,
            on_event=heard,
            target_event_cls=ProcessIO,
            target_action_cls=ExecuteProcess,
            **kwargs,
        )


class OnExecutionComplete(EventHandler):
    """Entities for when an action has done all it does, or a function (event, context) that gives them."""

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
        """As `BaseEventHandler`."""
        return super().describe()[0], [] if callable(self.__on_completion) else self.__on_completion

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """As `BaseEventHandler`."""
        super().handle(event, context)
        come = self.__on_completion
        return come(event, context) if callable(come) else come


class OnShutdown(BaseEventHandler):
    """Entities for when all ends, or a function (event, context) that gives them."""

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=lambda event: isinstance(event, Shutdown), **kwargs)
        self.__on_shutdown: Callable = on_shutdown if callable(on_shutdown) else lambda *_: on_shutdown

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """As `BaseEventHandler`."""
        super().handle(event, context)
        return self.__on_shutdown(event, context)


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
