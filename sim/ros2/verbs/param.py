"""ros2 param: the parameters of nodes, and what they are set to."""

from __future__ import annotations

import re
from argparse import Namespace
from pathlib import Path
from typing import Any

import yaml
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, SetParameters
from rclpy.parameter import get_parameter_value, parameter_dict_from_yaml_file, parameter_value_to_python

from sim.ros2.group import Group, argument, flag
from sim.ros2.parameters import names_of, values_of
from sim.ros2.system import System, Wrong, ask, is_hidden
from sim.suggestions import closest_match

param = Group("param", "Parameters of nodes: list, get, set, describe, dump, load")
NODE = argument("node_name", help="Name of the ROS node", offers=lambda system, _: system.nodes)


def _names(system: System, asked: Namespace) -> list[str]:
    """The parameters of the node that was named."""
    return names_of(system, system.node(asked.node_name))


NAME = argument("parameter_name", help="Name of the parameter", offers=_names)
HIDDEN = flag("--include-hidden-nodes", help="Consider hidden nodes as well")
LABELS = {
    "bool": "Boolean value is:",
    "integer": "Integer value is:",
    "double": "Double value is:",
    "string": "String value is:",
    "byte_array": "Byte values are:",
    "bool_array": "Boolean values are:",
    "integer_array": "Integer values are:",
    "double_array": "Double values are:",
    "string_array": "String values are:",
}
TYPES = {
    getattr(ParameterType, f"PARAMETER_{name.upper()}"): name
    for name in ("not_set", *LABELS)
}


def _type_text(number: int) -> str:
    return TYPES[number].replace("_", " ").replace("bool", "boolean")


@param.verb(
    "list",
    argument("node_name", nargs="?", help="Name of the ROS node", offers=lambda system, _: system.nodes),
    HIDDEN,
    argument("--filter", help="Only parameters whose names match this regular expression"),
    argument("--param-prefixes", nargs="+", default=[], help="Only those with these prefixes"),
    flag("--param-type", help="Print parameter types with parameter names"),
)
def list_(system: System, asked: Namespace) -> None:
    """Output a list of available parameters."""
    if asked.node_name:
        nodes = [system.node(asked.node_name, hidden=asked.include_hidden_nodes)]
    else:
        shown = {node for node in system.nodes if asked.include_hidden_nodes or not is_hidden(node)}
        nodes = sorted(shown, key=lambda node: node.rpartition("/")[::-1])  # by name, then by namespace
    for node in nodes:
        try:
            names = [name for name in names_of(system, node) if _wanted(name, asked)]
        except Wrong as wrong:  # a node may be without such services
            system.say(str(wrong))
            continue
        if not asked.node_name and names:
            system.say(f"{node}:")
        values = values_of(system, node, names) if asked.param_type else []
        for number, name in enumerate(names):
            kind = f" (type: {_type_text(values[number].type)})" if values else ""
            system.say(f"  {name}{kind}")


def _wanted(name: str, asked: Namespace) -> bool:
    prefixes = [prefix.rstrip(".") for prefix in asked.param_prefixes]
    inside = not prefixes or any(name == prefix or name.startswith(f"{prefix}.") for prefix in prefixes)
    return inside and (not asked.filter or re.match(asked.filter, name) is not None)


@param.verb("get", NODE, NAME, HIDDEN, flag("--hide-type", help="Hide the type information"))
def get(system: System, asked: Namespace) -> None:
    """Get parameter."""
    node = system.node(asked.node_name, hidden=asked.include_hidden_nodes)
    found = values_of(system, node, [asked.parameter_name])
    if not found or TYPES[found[0].type] == "not_set":
        near = closest_match(asked.parameter_name, names_of(system, node))
        raise Wrong("Parameter not set" + (f". Did you mean {near}?" if near else ""))
    value = _python(found[0])
    label = "" if asked.hide_type else LABELS[TYPES[found[0].type]] + " "
    system.say(f"{label}{value}")


def _python(value: ParameterValue) -> Any:
    plain = parameter_value_to_python(value)
    return plain.tolist() if hasattr(plain, "tolist") else plain


@param.verb("set", NODE, NAME, argument("value", help="Value of the parameter"), HIDDEN)
def set_(system: System, asked: Namespace) -> None:
    """Set parameter."""
    node = system.node(asked.node_name, hidden=asked.include_hidden_nodes)
    parameter = Parameter(name=asked.parameter_name, value=get_parameter_value(asked.value))
    ((_, result),) = _set(system, node, [parameter])
    reason = f": {result.reason}" if result.reason else ""
    if not result.successful:
        raise Wrong(f"Setting parameter failed{reason}")
    system.say(f"Set parameter successful{reason}")


def _set(system: System, node: str, parameters: list[Parameter]) -> list[tuple[Parameter, Any]]:
    request = SetParameters.Request(parameters=parameters)
    answered = system.act(lambda own, _: ask(own, SetParameters, f"{node}/set_parameters", request))
    return list(zip(parameters, answered.results, strict=True))


@param.verb(
    "describe",
    NODE,
    argument("parameter_names", nargs="+", help="Names of the parameters", offers=_names),
    HIDDEN,
)
def describe(system: System, asked: Namespace) -> None:
    """Show descriptive information about declared parameters."""
    node = system.node(asked.node_name, hidden=asked.include_hidden_nodes)
    request = DescribeParameters.Request(names=asked.parameter_names)
    service = f"{node}/describe_parameters"
    for one in system.act(lambda own, _: ask(own, DescribeParameters, service, request)).descriptors:
        lines = [f"Parameter name: {one.name}", f"  Type: {_type_text(one.type)}"]
        lines += [f"  Description: {one.description}"] if one.description else []
        lines += ["  Constraints:"]
        lines += ["    Read only: true"] if one.read_only else []
        for limits in [*one.floating_point_range, *one.integer_range][:1]:
            lines += [f"    Min value: {limits.from_value}", f"    Max value: {limits.to_value}"]
            lines += [f"    Step: {limits.step}"] if limits.step else []
        if one.additional_constraints:
            lines += [f"    Additional constraints: {one.additional_constraints}"]
        system.say("\n".join(lines))


@param.verb("dump", NODE, HIDDEN)
def dump(system: System, asked: Namespace) -> None:
    """Show all of the parameters of a node in a YAML file format."""
    node = system.node(asked.node_name, hidden=asked.include_hidden_nodes)
    names = names_of(system, node)
    tree: dict[str, Any] = {}
    for name, value in zip(names, values_of(system, node, names), strict=True):
        *groups, last = name.split(".")
        branch = tree
        for group in groups:
            branch = branch.setdefault(group, {})
        branch[last] = _python(value)
    system.say(yaml.dump({node: {"ros__parameters": tree}}, default_flow_style=False))


@param.verb(
    "load",
    NODE,
    argument("parameter_file", type=Path, help="Parameter file"),
    HIDDEN,
    flag("--no-use-wildcard", help="Do not load parameters in the '/**' namespace into the node"),
)
def load(system: System, asked: Namespace) -> None:
    """Load parameter file for a node."""
    node = system.node(asked.node_name, hidden=asked.include_hidden_nodes)
    try:
        found = parameter_dict_from_yaml_file(
            str(asked.parameter_file), not asked.no_use_wildcard, target_nodes=[node]
        )
    except OSError as error:
        raise Wrong(f"{asked.parameter_file} can't be read: {error.strerror}") from None
    except (RuntimeError, yaml.YAMLError) as error:
        raise Wrong(f"{asked.parameter_file} has no parameters for {node}: {error}") from None
    for parameter, result in _set(system, node, list(found.values())):
        reason = f": {result.reason}" if result.reason else ""
        word = "successful" if result.successful else "failed"
        system.say(f"Set parameter {parameter.name} {word}{reason}")
