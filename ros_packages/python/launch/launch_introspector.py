"""Prints a launch description as a tree."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler
from launch.launch_description import LaunchDescription
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.substitution import SomeSubstitutionsType
from launch.utilities import describe_substitutions, normalize_to_list_of_substitutions


class LaunchIntrospector:
    """Formats launch descriptions."""

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """The entities of a description, as a tree."""
        return "\n".join([str(launch_description), *_tree(launch_description.entities)])


def _tree(entities: Iterable[LaunchDescriptionEntity]) -> Iterator[str]:
    entities = list(entities)
    for entity in entities:
        last = entity is entities[-1]
        yield f"{'└' if last else '├'}── {_line(entity)}"
        if isinstance(entity, RegisterEventHandler):
            text, inner = entity.event_handler.describe()
            yield f"{' ' if last else '│'}   └── {text}"
            for line in _tree(inner):
                yield f"{' ' if last else '│'}       {line}"


def _line(entity: LaunchDescriptionEntity) -> str:
    if isinstance(entity, LogInfo):
        return f"LogInfo({describe_substitutions(entity.msg)})"
    if isinstance(entity, EmitEvent):
        return f"EmitEvent(event='{entity.event.name}')"
    if isinstance(entity, ExecuteProcess):
        words = ", ".join(_describe(word) for word in entity.cmd)
        cwd = None if entity.cwd is None else f"'{_describe(entity.cwd)}'"
        return f"ExecuteProcess(cmd=[{words}], cwd={cwd}, env={_variables(entity.env)}, shell={entity.shell})"
    if isinstance(entity, RegisterEventHandler):
        return f"RegisterEventHandler('{entity.event_handler}'):"
    return f"Action('{entity}')"


def _variables(env: Any) -> str | None:
    if env is None:
        return None
    return "{" + ", ".join(f"{_describe(name)}: {_describe(value)}" for name, value in env.items()) + "}"


def _describe(subs: SomeSubstitutionsType) -> str:
    return describe_substitutions(normalize_to_list_of_substitutions(subs))
