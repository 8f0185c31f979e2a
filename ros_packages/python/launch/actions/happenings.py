"""Actions that are about what happens, and when."""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Iterable
from typing import Any

from launch.actions.flow import OpaqueFunction
from launch.entities import (
    Action,
    BaseEventHandler,
    Event,
    EventHandler,
    LaunchDescriptionEntity,
    SomeSubstitutionsType,
    Substitution,
)
from launch.events import Shutdown as ShutdownEvent
from launch.events import TimerEvent
from launch.events.process import ProcessExited
from launch.launch_context import LaunchContext
from launch.logging import get_logger
from launch.utilities import ensure_argument_type, value_of


class RegisterEventHandler(Action):
    """From here on this is done when something happens."""

    def __init__(self, event_handler: BaseEventHandler, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__event_handler = event_handler

    @property
    def event_handler(self) -> BaseEventHandler:
        """What is done, and when."""
        return self.__event_handler

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """As `LaunchDescriptionEntity`."""
        text, entities = self.__event_handler.describe()
        return [(text, entities)] if entities else []

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        context.register_event_handler(self.__event_handler)


class EmitEvent(Action):
    """Tells of an event."""

    def __init__(self, *, event: Event, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if not isinstance(event, Event):
            raise RuntimeError(f"EmitEvent() expected an event instance, got '{event}'.")
        self.__event = event

    @property
    def event(self) -> Event:
        """The event."""
        return self.__event

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        context.emit_event_sync(self.__event)


class Shutdown(EmitEvent):
    """Ends all that was launched."""

    def __init__(self, *, reason: str = "reason not given", **kwargs: Any) -> None:
        super().__init__(event=ShutdownEvent(reason=reason), **kwargs)

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        event = context.get_locals_as_dict().get("event")
        if isinstance(event, ProcessExited):
            get_logger("launch").info(
                f"process[{event.process_name}] was required: shutting down launched system"
            )
        super().execute(context)


class TimerAction(Action):
    """Actions that come `period` seconds later."""

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        kinds = (str, Substitution, Iterable, float)
        ensure_argument_type(period, kinds, "period", "TimerAction")
        ensure_argument_type(actions, Iterable, "actions", "TimerAction")
        if isinstance(period, str):
            text = "The parameter 'period' must be a float or substitution,"
            warnings.warn(f"{text}passing a string literal was deprecated", stacklevel=2)
        self.__period, self.__actions, self.__cancel = period, list(actions), cancel_on_shutdown
        self.__canceled = False
        self.__done: asyncio.Future | None = None
        self.__locals: dict[str, Any] = {}

    @property
    def period(self) -> Any:
        """How much later, in seconds."""
        return self.__period

    @property
    def actions(self) -> list[LaunchDescriptionEntity]:
        """What comes then."""
        return self.__actions

    def describe(self) -> str:
        """As `Action`."""
        return f"TimerAction(period={self.__period}, actions=<actions>)"

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """As `LaunchDescriptionEntity`."""
        return [(f"{self.__period} seconds pass without being canceled", self.__actions)]

    def get_asyncio_future(self) -> asyncio.Future | None:
        """As `LaunchDescriptionEntity`."""
        return self.__done

    def cancel(self) -> None:
        """They don't come any more."""
        self.__canceled = True
        if self.__done is not None and not self.__done.done():
            self.__done.set_result(None)

    def execute(self, context: LaunchContext) -> None:
        """As `Action`."""
        self.__done = context.asyncio_loop.create_future()
        if self.__canceled:
            self.__done.set_result(None)
            return
        self.__locals = context.get_locals_as_dict()
        context.register_event_handler(
            EventHandler(
                matcher=lambda event: isinstance(event, TimerEvent) and event.timer_action is self,
                entities=OpaqueFunction(function=self.__fire),
                handle_once=True,
            )
        )
        context.asyncio_loop.call_later(value_of(context, self.__period, float), self.__is_time, context)
        if value_of(context, self.__cancel, bool):
            context.register_event_handler(
                EventHandler(
                    matcher=lambda event: isinstance(event, ShutdownEvent),
                    entities=OpaqueFunction(function=lambda context: self.cancel()),
                )
            )

    def __is_time(self, context: LaunchContext) -> None:
        if not self.__done.done():
            context.emit_event_sync(TimerEvent(timer_action=self))
            self.__done.set_result(None)

    def __fire(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        context.extend_locals(self.__locals)
        return self.__actions
