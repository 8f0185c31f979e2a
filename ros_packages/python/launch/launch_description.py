"""A launch description: what is to be launched, in order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from launch.entities import Action, LaunchDescriptionEntity
from launch.launch_context import LaunchContext
from launch.logging import get_logger


class LaunchDescription(LaunchDescriptionEntity):
    """Entities, which are visited in this order. deprecated_reason: said as a warning, if there is one."""

    def __init__(
        self,
        initial_entities: Iterable[LaunchDescriptionEntity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        self.__entities = list(initial_entities or ())
        self.__deprecated_reason = deprecated_reason

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """What is in it."""
        return self.__entities

    @property
    def deprecated(self) -> bool:
        """Whether another is to be used in its place."""
        return self.__deprecated_reason is not None

    @property
    def deprecated_reason(self) -> str | None:
        """Why."""
        return self.__deprecated_reason

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Add one more."""
        self.__entities.append(entity)

    def add_action(self, action: Action) -> None:
        """Add one more."""
        self.add_entity(action)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """As `LaunchDescriptionEntity`."""
        return self.__entities

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """As `LaunchDescriptionEntity`."""
        if self.deprecated:
            path = context.get_locals_as_dict().get("current_launch_file_path")
            what = "deprecated launch description" if path is None else f"launch file [{path}] is deprecated"
            get_logger().warning(f"{what}: {self.__deprecated_reason}")
        return self.__entities

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[Any]:
        """The arguments that it declares, and those of the files that it includes."""
        return _first_of_each(_declared(self.entities, conditional_inclusion))

    def _own_arguments(self) -> list[Any]:
        """The arguments that it declares itself."""
        return _first_of_each(_declared(self.entities, False, included=False))


def _first_of_each(declared: Iterable[tuple[Any, bool]]) -> list[Any]:
    found: dict[str, Any] = {}
    for argument, conditional in declared:
        if argument.name not in found:
            argument._conditionally_included = conditional or argument.condition is not None
            found[argument.name] = argument
    return list(found.values())


def _declared(
    entities: Iterable[LaunchDescriptionEntity], conditional: bool, included: bool = True
) -> Iterator[tuple[Any, bool]]:
    from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription  # which need this module

    for entity in entities:
        if isinstance(entity, DeclareLaunchArgument):
            yield entity, conditional
        if included or not isinstance(entity, IncludeLaunchDescription):
            yield from _declared(entity.describe_sub_entities(), conditional, included)
            for _, inner in entity.describe_conditional_sub_entities():
                yield from _declared(inner, True, included)
