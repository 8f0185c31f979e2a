"""ros2 param: parameters of nodes and their values."""

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
from sim.ros2.node_parameters import names_of, values_of
from sim.ros2.system import CliError, System, is_hidden
from sim.suggestions import closest_match

param = Group("param", "Parameters of nodes: list, get, set, describe, dump, load")
NODE = argument("node_name", help="Name of the ROS node", completer=lambda system, _: system.nodes)


def _node(system: System, options: Namespace) -> str:
    """The full name of the node in the options."""
    return system.node(options.node_name, hidden=options.include_hidden_nodes, seconds=options.timeout)


def _names(system: System, options: Namespace) -> list[str]:
    """The parameters of the node in the options."""
    return names_of(system, system.node(options.node_name))


NAME = argument("parameter_name", help="Name of the parameter", completer=_names)
HIDDEN = flag("--include-hidden-nodes", help="Consider hidden nodes as well")
TIMEOUT = argument("--timeout", type=int, metavar="N", help="Wait for N seconds until node becomes available")
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
TYPES = {getattr(ParameterType, f"PARAMETER_{name.upper()}"): name for name in ("not_set", *LABELS)}


def _type_text(number: int) -> str:
    return TYPES[number].replace("_", " ").replace("bool", "boolean")


@param.verb(
    "list",
    argument("node_name", nargs="?", help="Name of the ROS node", completer=lambda system, _: system.nodes),
    HIDDEN,
    argument("--filter", help="Only parameters whose names match this regular expression"),
    argument("--param-prefixes", nargs="+", default=[], help="Only those with these prefixes"),
    flag("--param-type", help="Print parameter types with parameter names"),
)
def list_(system: System, options: Namespace) -> None:
    """Output a list of available parameters."""
    if options.node_name:
        nodes = [system.node(options.node_name, hidden=options.include_hidden_nodes)]
    else:
        shown = {node for node in system.nodes if options.include_hidden_nodes or not is_hidden(node)}
        nodes = sorted(shown, key=lambda node: node.rpartition("/")[::-1])  # by name, then by namespace
    for node in nodes:
        try:
            names = [name for name in names_of(system, node) if _is_selected(name, options)]
        except CliError as error:  # a node may lack parameter services
            system.print_line(str(error))
            continue
        if not options.node_name and names:
            system.print_line(f"{node}:")
        values = values_of(system, node, names) if options.param_type else []
        for number, name in enumerate(names):
            kind = f" (type: {_type_text(values[number].type)})" if values else ""
            system.print_line(f"  {name}{kind}")


def _is_selected(name: str, options: Namespace) -> bool:
    prefixes = [prefix.rstrip(".") for prefix in options.param_prefixes]
    inside = not prefixes or any(name == prefix or name.startswith(f"{prefix}.") for prefix in prefixes)
    return inside and (not options.filter or re.match(options.filter, name) is not None)


@param.verb("get", NODE, NAME, HIDDEN, TIMEOUT, flag("--hide-type", help="Hide the type information"))
def get(system: System, options: Namespace) -> None:
    """Get parameter."""
    node = _node(system, options)
    found = values_of(system, node, [options.parameter_name])
    if not found or TYPES[found[0].type] == "not_set":
        near = closest_match(options.parameter_name, names_of(system, node))
        raise CliError("Parameter not set" + (f". Did you mean {near}?" if near else ""))
    value = _python(found[0])
    label = "" if options.hide_type else LABELS[TYPES[found[0].type]] + " "
    system.print_line(f"{label}{value}")


def _python(value: ParameterValue) -> Any:
    plain = parameter_value_to_python(value)
    return plain.tolist() if hasattr(plain, "tolist") else plain


@param.verb("set", NODE, NAME, argument("value", help="Value of the parameter"), HIDDEN, TIMEOUT)
def set_(system: System, options: Namespace) -> None:
    """Set parameter."""
    node = _node(system, options)
    parameter = Parameter(name=options.parameter_name, value=get_parameter_value(options.value))
    ((_, result),) = _set(system, node, [parameter])
    reason = f": {result.reason}" if result.reason else ""
    if not result.successful:
        raise CliError(f"Setting parameter failed{reason}")
    system.print_line(f"Set parameter successful{reason}")


@param.verb("delete", NODE, NAME, HIDDEN, TIMEOUT)
def delete(system: System, options: Namespace) -> None:
    """Delete parameter."""
    node = _node(system, options)
    ((_, result),) = _set(system, node, [Parameter(name=options.parameter_name)])
    reason = f": {result.reason}" if result.reason else ""
    if not result.successful:
        raise CliError(f"Deleting parameter failed{reason}")
    system.print_line(f"Deleted parameter successfully{reason}")


def _set(system: System, node: str, parameters: list[Parameter]) -> list[tuple[Parameter, Any]]:
    request = SetParameters.Request(parameters=parameters)
    response = system.call(SetParameters, f"{node}/set_parameters", request)
    return list(zip(parameters, response.results, strict=True))


@param.verb(
    "describe",
    NODE,
    argument("parameter_names", nargs="+", help="Names of the parameters", completer=_names),
    HIDDEN,
    TIMEOUT,
)
def describe(system: System, options: Namespace) -> None:
    """Show descriptive information about declared parameters."""
    node = _node(system, options)
    request = DescribeParameters.Request(names=options.parameter_names)
    for each in system.call(DescribeParameters, f"{node}/describe_parameters", request).descriptors:
        lines = [f"Parameter name: {each.name}", f"  Type: {_type_text(each.type)}"]
        lines += [f"  Description: {each.description}"] if each.description else []
        lines += ["  Constraints:"]
        lines += ["    Read only: true"] if each.read_only else []
        for limits in [*each.floating_point_range, *each.integer_range][:1]:
            lines += [f"    Min value: {limits.from_value}", f"    Max value: {limits.to_value}"]
            lines += [f"    Step: {limits.step}"] if limits.step else []
        if each.additional_constraints:
            lines += [f"    Additional constraints: {each.additional_constraints}"]
        system.print_line("\n".join(lines))


@param.verb("dump", NODE, HIDDEN, TIMEOUT)
def dump(system: System, options: Namespace) -> None:
    """Show all of the parameters of a node in a YAML file format."""
    node = _node(system, options)
    names = names_of(system, node)
    tree: dict[str, Any] = {}
    for name, value in zip(names, values_of(system, node, names), strict=True):
        *groups, last = name.split(".")
        branch = tree
        for group in groups:
            branch = branch.setdefault(group, {})
        branch[last] = _python(value)
    system.print_line(yaml.dump({node: {"ros__parameters": tree}}, default_flow_style=False))


@param.verb(
    "load",
    NODE,
    argument("parameter_file", type=Path, help="Parameter file"),
    HIDDEN,
    TIMEOUT,
    flag("--no-use-wildcard", help="Do not load parameters in the '/**' namespace into the node"),
)
def load(system: System, options: Namespace) -> None:
    """Load parameter file for a node."""
    node = _node(system, options)
    try:
        found = parameter_dict_from_yaml_file(
            str(options.parameter_file), not options.no_use_wildcard, target_nodes=[node]
        )
    except OSError as error:
        raise CliError(f"{options.parameter_file} can't be read: {error.strerror}") from None
    except (RuntimeError, yaml.YAMLError) as error:
        raise CliError(f"{options.parameter_file} has no parameters for {node}: {error}") from None
    for parameter, result in _set(system, node, list(found.values())):
        reason = f": {result.reason}" if result.reason else ""
        outcome = "successful" if result.successful else "failed"
        system.print_line(f"Set parameter {parameter.name} {outcome}{reason}")
