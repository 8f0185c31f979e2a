"""The action `TimerAction`."""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Iterable
from typing import Any

from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.event_handler import EventHandler
from launch.events import Shutdown, TimerEvent
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import ensure_argument_type, value_of


class TimerAction(Action):
    """Executes actions `period` seconds later."""

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
        self.__future: asyncio.Future | None = None
        self.__locals: dict[str, Any] = {}

    @property
    def period(self) -> Any:
        """The delay in seconds."""
        return self.__period

    @property
    def actions(self) -> list[LaunchDescriptionEntity]:
        """The actions to execute."""
        return self.__actions

    def describe(self) -> str:
        """Work like `Action`."""
        return f"TimerAction(period={self.__period}, actions=<actions>)"

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Work like `LaunchDescriptionEntity`."""
        return [(f"{self.__period} seconds pass without being canceled", self.__actions)]

    def get_asyncio_future(self) -> asyncio.Future | None:
        """Work like `LaunchDescriptionEntity`."""
        return self.__future

    def cancel(self) -> None:
        """Don't execute the actions."""
        self.__canceled = True
        if self.__future is not None and not self.__future.done():
            self.__future.set_result(None)

    def execute(self, context: LaunchContext) -> None:
        """Work like `Action`."""
        self.__future = context.asyncio_loop.create_future()
        if self.__canceled:
            self.__future.set_result(None)
            return
        self.__locals = context.get_locals_as_dict()
        context.register_event_handler(
            EventHandler(
                matcher=lambda event: isinstance(event, TimerEvent) and event.timer_action is self,
                entities=OpaqueFunction(function=self.__get_actions),
                handle_once=True,
            )
        )
        context.asyncio_loop.call_later(value_of(context, self.__period, float), self.__on_time, context)
        if value_of(context, self.__cancel, bool):
            context.register_event_handler(
                EventHandler(
                    matcher=lambda event: isinstance(event, Shutdown),
                    entities=OpaqueFunction(function=lambda context: self.cancel()),
                )
            )

    def __on_time(self, context: LaunchContext) -> None:
        if not self.__future.done():
            context.emit_event_sync(TimerEvent(timer_action=self))
            self.__future.set_result(None)

    def __get_actions(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        context.extend_locals(self.__locals)
        return self.__actions
