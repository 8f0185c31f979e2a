"""The actions for nodes in launch files in YAML and XML."""

from __future__ import annotations

from typing import Any

import yaml
from launch.action import Action
from launch.yaml_frontend.actions import parse_command, process_options
from launch.yaml_frontend.entity import Entity, expose_action
from launch.yaml_frontend.xml_file import XmlText

from launch_ros.actions import (
    LifecycleNode,
    Node,
    PushRosNamespace,
    SetParameter,
    SetRemap,
)
from launch_ros.parameters import ParameterFile, ParameterValue

TYPES = {"str": str, "int": int, "float": float, "bool": bool}


@expose_action("node")
def _node(entity: Entity) -> Action:
    return Node(**_node_arguments(entity))


@expose_action("lifecycle_node")
def _lifecycle_node(entity: Entity) -> Action:
    name, namespace = (entity.get_text(key, optional=False) for key in ("name", "namespace"))
    given = _node_arguments(entity) | {"name": name, "namespace": namespace}
    autostart = entity.get_text("autostart")
    return LifecycleNode(**given, autostart=False if autostart is None else autostart)


def _node_arguments(entity: Entity) -> dict[str, Any]:
    remappings = [
        (remap.get_text("from", False), remap.get_text("to", False)) for remap in entity.get_entities("remap")
    ]
    return {
        "executable": entity.get_text("exec", optional=False),
        "package": entity.get_text("pkg"),
        "name": entity.get_text("name"),
        "namespace": entity.get_text("namespace"),
        "exec_name": entity.get_text("exec_name"),
        "parameters": [_parameter(part) for part in entity.get_entities("param")],
        "remappings": remappings,
        "arguments": parse_command(entity, "args"),
        "ros_arguments": parse_command(entity, "ros_args"),
    } | process_options(entity)


def _parameter(entity: Entity) -> Any:
    file, name = entity.get_text("from"), entity.get_text("name")
    if file is not None and name is not None:
        raise RuntimeError("name and from attributes are mutually exclusive")
    if file is not None:
        found: Any = ParameterFile(file, allow_substs=bool(entity.get("allow_substs", bool, optional=True)))
    elif name is not None:
        found = {tuple(name): _value(entity)}
    else:
        raise ValueError("param Entity should have name or from attribute")
    entity.check_all_keys_read()
    return found


def _value(entity: Entity) -> Any:
    """The value of a parameter, or the values of the nested ones."""
    nested, value = entity.get_entities("param"), entity.get("value", object, optional=True)
    kind = entity.get("type", str, optional=True)
    if value is not None and nested:
        raise RuntimeError("nested parameters and value attributes are mutually exclusive")
    if nested:
        found = {}
        for part in nested:
            found[tuple(part.get_text("name", False))] = _value(part)
            part.check_all_keys_read()
        return found
    if value is None:
        raise RuntimeError("either a value attribute or nested params are needed")
    if kind is not None and kind not in TYPES:
        raise ValueError(f"'{kind}' is not a parameter type here: there are {', '.join(TYPES)}.")
    if not isinstance(value, str):
        return value if kind is None else ParameterValue(value, value_type=TYPES[kind])
    separator = entity.get("value-sep", str, optional=True)
    if isinstance(value, XmlText) and kind is None and "$(" not in value:
        return _typed(value) if separator is None else [_typed(part) for part in value.split(separator)]
    text = entity.get_text("value")
    if kind is not None:
        return ParameterValue(text, value_type=TYPES[kind])
    return value if "$(" not in value else text


def _typed(text: str) -> Any:
    """Return what an attribute of XML holds: a number, true or false, or a list of such; else the text."""
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError:
        return str(text)
    return found if isinstance(found, bool | int | float | list) else str(text)


@expose_action("push_ros_namespace", "push-ros-namespace")
def _push(entity: Entity) -> Action:
    return PushRosNamespace(entity.get_text("namespace", optional=False), **entity.condition())


@expose_action("set_remap")
def _set_remap(entity: Entity) -> Action:
    source, target = entity.get_text("from", optional=False), entity.get_text("to", optional=False)
    return SetRemap(source, target, **entity.condition())


@expose_action("set_parameter")
def _set_parameter(entity: Entity) -> Action:
    name, value = entity.get_text("name", optional=False), entity.get_text("value", optional=False)
    return SetParameter(name, value[0] if len(value) == 1 else value, **entity.condition())
