"""The words for nodes in launch files in YAML."""

from __future__ import annotations

from typing import Any

from launch import Action
from launch.yaml_files import Entity, process_options, word_for, words
from launch.yaml_texts import SUBSTITUTIONS

from launch_ros.actions import Node, PushRosNamespace, SetParameter
from launch_ros.parameters import ParameterFile, ParameterValue
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare

SUBSTITUTIONS["find-pkg-share"] = (1, 1, FindPackageShare)
SUBSTITUTIONS["find-pkg-prefix"] = (1, 1, FindPackagePrefix)
SUBSTITUTIONS["exec-in-pkg"] = (2, 2, ExecutableInPackage)
TYPES = {"str": str, "int": int, "float": float, "bool": bool}


@word_for("node")
def _node(entity: Entity) -> Action:
    remappings = [(remap.text("from", False), remap.text("to", False)) for remap in entity.inner("remap")]
    given = {
        "package": entity.text("pkg"),
        "name": entity.text("name"),
        "namespace": entity.text("namespace"),
        "exec_name": entity.text("exec_name"),
        "parameters": [_parameter(part) for part in entity.inner("param")],
        "remappings": remappings,
        "arguments": words(entity, "args"),
        "ros_arguments": words(entity, "ros_args"),
    }
    executable = entity.text("exec", optional=False)
    return Node(executable=executable, **given, **process_options(entity))


def _parameter(entity: Entity) -> Any:
    file, name = entity.text("from"), entity.text("name")
    if file is not None and name is not None:
        raise RuntimeError("name and from attributes are mutually exclusive")
    if file is not None:
        found: Any = ParameterFile(file, allow_substs=bool(entity.value("allow_substs", bool, optional=True)))
    elif name is not None:
        found = {tuple(name): _value(entity)}
    else:
        raise ValueError("param Entity should have name or from attribute")
    entity.check()
    return found


def _value(entity: Entity) -> Any:
    """A value, or those of the parameters within."""
    nested, value = entity.inner("param"), entity.value("value", object, optional=True)
    kind = entity.value("type", str, optional=True)
    if value is not None and nested:
        raise RuntimeError("nested parameters and value attributes are mutually exclusive")
    if nested:
        found = {}
        for part in nested:
            found[tuple(part.text("name", False))] = _value(part)
            part.check()
        return found
    if value is None:
        raise RuntimeError("either a value attribute or nested params are needed")
    if kind is not None and kind not in TYPES:
        raise ValueError(f"'{kind}' is no type of a parameter here: there are {', '.join(TYPES)}.")
    if not isinstance(value, str):
        return value if kind is None else ParameterValue(value, value_type=TYPES[kind])
    text = entity.text("value")
    if kind is not None:
        return ParameterValue(text, value_type=TYPES[kind])
    return value if "$(" not in value else text


@word_for("push_ros_namespace", "push-ros-namespace")
def _push(entity: Entity) -> Action:
    return PushRosNamespace(entity.text("namespace", optional=False), **entity.options())


@word_for("set_parameter")
def _set_parameter(entity: Entity) -> Action:
    name, value = entity.text("name", optional=False), entity.text("value", optional=False)
    return SetParameter(name, value[0] if len(value) == 1 else value, **entity.options())
