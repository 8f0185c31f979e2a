"""What a launch description is made of: entities, of which actions do something, and what they are given."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from asyncio import Future

    from launch.launch_context import LaunchContext


class LaunchDescriptionEntity:
    """Anything that may stand in a launch description."""

    def describe(self) -> str:
        """A text for people."""
        return repr(self)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """The entities in it that come whenever it does."""
        return []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """The entities in it that come on a condition, each with a text on that."""
        return []

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Do its part; what it returns is visited next."""
        return None

    def get_asyncio_future(self) -> Future | None:
        """What is done when it has come to its end; None if that is at once."""
        return None


class Substitution:
    """A text that is known only when the launch file runs."""

    def describe(self) -> str:
        """A text for people."""
        return repr(self)

    def perform(self, context: LaunchContext) -> str:
        """The text."""
        return ""


class SubstitutionFailure(RuntimeError):
    """A substitution has no text to give."""


class Condition:
    """Whether an action is done. `predicate` is asked when its turn comes."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """A text for people."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """Ask it."""
        return self._predicate is not None and self._predicate(context)


class Action(LaunchDescriptionEntity):
    """An entity that does something, if its condition holds."""

    def __init__(self, *, condition: Condition | None = None) -> None:
        self.__condition = condition

    @property
    def condition(self) -> Condition | None:
        """The condition, if there is one."""
        return self.__condition

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """The entities in it."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """As `LaunchDescriptionEntity`."""
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """As `LaunchDescriptionEntity`."""
        if self.condition is None:
            return []
        return [(f"Conditionally included by {self.describe()}", self.get_sub_entities())]

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """As `LaunchDescriptionEntity`; `execute` is what actions differ in."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            self.__tell_of_its_end(context)

    def __tell_of_its_end(self, context: LaunchContext) -> None:
        from launch.events import ExecutionComplete  # which needs what is here

        event, future = ExecutionComplete(action=self), self.get_asyncio_future()
        if not context.would_handle_event(event):
            return
        if future is None:
            context.emit_event_sync(event)
        else:
            future.add_done_callback(lambda _: context.emit_event_sync(event))

    def execute(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Do it; what is returned is visited next."""
        return None


class Event:
    """Something that has happened, of which handlers are told."""

    name = "launch.Event"


class BaseEventHandler:
    """What is done about an event that `matcher` is true of; with `handle_once`, about the first alone."""

    def __init__(self, *, matcher: Callable[[Event], bool], handle_once: bool = False) -> None:
        self.__matcher, self.__handle_once = matcher, handle_once

    @property
    def handle_once(self) -> bool:
        """Whether it is for the first such event alone."""
        return self.__handle_once

    def matches(self, event: Event) -> bool:
        """Whether it is about such an event."""
        return self.__matcher(event)

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """A text for people, and the entities that may come of it."""
        return type(self).__name__, []

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """What comes of the event: entities, or None."""
        context.extend_locals({"event": event})
        if self.handle_once:
            context.unregister_event_handler(self)
        return None


class EventHandler(BaseEventHandler):
    """A handler that brings in entities."""

    def __init__(
        self, *, matcher: Callable[[Event], bool], entities: Any = None, handle_once: bool = False
    ) -> None:
        super().__init__(matcher=matcher, handle_once=handle_once)
        self.__entities = entities

    @property
    def entities(self) -> Any:
        """What it brings in."""
        return self.__entities

    def describe(self) -> tuple[str, list[LaunchDescriptionEntity]]:
        """As `BaseEventHandler`."""
        return super().describe()[0], as_list(self.__entities)

    def handle(self, event: Event, context: LaunchContext) -> Any:
        """As `BaseEventHandler`."""
        super().handle(event, context)
        return self.__entities


def as_list(entities: Any) -> list[LaunchDescriptionEntity]:
    """None, one entity or several of them, as a list."""
    if entities is None:
        return []
    return list(entities) if isinstance(entities, Iterable) else [entities]


SomeSubstitutionsType = str | Substitution | Iterable[str | Substitution]
SomeEntitiesType = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]
