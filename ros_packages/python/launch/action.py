"""The base class of actions."""

from __future__ import annotations

from collections.abc import Iterable

from launch.condition import Condition
from launch.events import ExecutionComplete
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.located import place_in_python


class Action(LaunchDescriptionEntity):
    """An entity that does something if its condition holds. Subclasses override `execute`."""

    def __init__(self, *, condition: Condition | None = None) -> None:
        self.__condition = condition
        self.place: str | None = None  # of its entity in a launch file in XML or YAML: "FILE, line N"
        self.place_in_python = place_in_python()

    @property
    def condition(self) -> Condition | None:
        """The condition, if there is one."""
        return self.__condition

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """The entities in it."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Work like `LaunchDescriptionEntity`."""
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Work like `LaunchDescriptionEntity`."""
        if self.condition is None:
            return []
        return [(f"Conditionally included by {self.describe()}", self.get_sub_entities())]

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Execute the action if its condition holds."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            self.__announce_completion(context)

    def __announce_completion(self, context: LaunchContext) -> None:
        event, future = ExecutionComplete(action=self), self.get_asyncio_future()
        if not context.would_handle_event(event):
            return
        if future is None:
            context.emit_event_sync(event)
        else:
            future.add_done_callback(lambda _: context.emit_event_sync(event))

    def execute(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Do what the action is for. The entities that it returns are visited next."""
        return None
