"""The base classes of event handlers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from launch.event import Event
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity, as_list


class BaseEventHandler:
    """Reacts to the events that `matcher` returns True for; with `handle_once`, to the first of them only."""

    def __init__(self, *, matcher: Callable[[Event], bool], handle_once: bool = False) -> None:
        self.__matcher, self.__handle_once = matcher, handle_once

    @property
    def handle_once(self) -> bool:
        """Return whether only the first matching event is handled."""
        return self.__handle_once

    def matches(self, event: Event) -> bool:
        """Return whether the event is handled."""
        return self.__matcher(event)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """A description for people, and the entities that the handler may return."""
        return type(self).__name__, []

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Handle the event. Returns entities to visit, or None."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """Returns entities to visit when the event occurs."""

    def __init__(
        self, *, matcher: Callable[[Event], bool], entities: Any = None, handle_once: bool = False
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.__entities = entities

    @property
    def entities(self) -> Any:
        """The entities to visit."""
        return self.__entities

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """Work like `BaseEventHandler`."""
        return super().describe()[0], as_list(self.__entities)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Work like `BaseEventHandler`."""
        super().handle(event, context)
        return self.__entities


class OnActionEventBase(BaseEventHandler):
    """Handles one type of event of one action, of the actions that a function returns True for, or of all."""

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
        """Work like `BaseEventHandler`."""
        return super().describe()[0], [] if callable(self.__on_event) else list(self.__on_event)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """Work like `BaseEventHandler`."""
        super().handle(event, context)
        return self.__on_event(event, context) if callable(self.__on_event) else self.__on_event
