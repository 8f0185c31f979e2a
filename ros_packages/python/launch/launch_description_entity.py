"""The base class of everything that a launch description contains."""

from __future__ import annotations

from asyncio import Future
from collections.abc import Iterable
from typing import Any

from launch.launch_context import LaunchContext


class LaunchDescriptionEntity:
    """Anything that a launch description may contain."""

    def describe(self) -> str:
        """A description for people."""
        return repr(self)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """The entities in it that are visited whenever it is."""
        return []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """The entities in it that are visited on a condition, each with a description of the condition."""
        return []

    def visit(self, context: LaunchContext) -> Iterable[LaunchDescriptionEntity] | None:
        """Execute the entity. The entities that it returns are visited next."""
        return None

    def get_asyncio_future(self) -> Future | None:
        """A future that is done when the entity is; None if it is done as soon as it was visited."""
        return None


def as_list(entities: Any) -> list[LaunchDescriptionEntity]:
    """None, one entity or several of them, as a list."""
    if entities is None:
        return []
    return list(entities) if isinstance(entities, Iterable) else [entities]


SomeEntitiesType = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]
