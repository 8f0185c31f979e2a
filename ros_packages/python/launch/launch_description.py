"""The launch description: what is to be launched, in order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from launch.action import Action
from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.logging import get_logger


class LaunchDescription(LaunchDescriptionEntity):
    """Entities that are visited in this order. deprecated_reason: logged as a warning, if given."""

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
        """The entities."""
        return self.__entities

    @property
    def deprecated(self) -> bool:
        """Return whether the description is deprecated."""
        return self.__deprecated_reason is not None

    @property
    def deprecated_reason(self) -> str | None:
        """Return why it is deprecated."""
        return self.__deprecated_reason

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Add an entity at the end."""
        self.__entities.append(entity)

    def add_action(self, action: Action) -> None:
        """Add an action at the end."""
        self.add_entity(action)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Work like `LaunchDescriptionEntity`."""
        return self.__entities

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Work like `LaunchDescriptionEntity`."""
        if self.deprecated:
            path = context.get_locals_as_dict().get("current_launch_file_path")
            what = "deprecated launch description" if path is None else f"launch file [{path}] is deprecated"
            get_logger().warning(f"{what}: {self.__deprecated_reason}")
        return self.__entities

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[DeclareLaunchArgument]:
        """The arguments that it declares, and those of the files that it includes."""
        return _unique(_declared_arguments(self.entities, conditional_inclusion))

    def _arguments(self, *, outside: type) -> list[DeclareLaunchArgument]:
        """The arguments that it declares, except those in entities of this type."""
        return _unique(_declared_arguments(self.entities, False, outside))


def _unique(declared: Iterable[tuple[DeclareLaunchArgument, bool]]) -> list[DeclareLaunchArgument]:
    """The first argument of each name."""
    found: dict[str, DeclareLaunchArgument] = {}
    for argument, conditional in declared:
        if argument.name not in found:
            argument._conditionally_included = conditional or argument.condition is not None
            found[argument.name] = argument
    return list(found.values())


def _declared_arguments(
    entities: Iterable[LaunchDescriptionEntity], conditional: bool, outside: type | tuple[()] = ()
) -> Iterator[tuple[DeclareLaunchArgument, bool]]:
    """Each declared argument, and whether it is declared on a condition only."""
    for entity in entities:
        if isinstance(entity, DeclareLaunchArgument):
            yield entity, conditional
        if not isinstance(entity, outside):
            yield from _declared_arguments(entity.describe_sub_entities(), conditional, outside)
            for _, inner in entity.describe_conditional_sub_entities():
                yield from _declared_arguments(inner, True, outside)
