"""ros2 interface: the installed message, service and action types."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Iterator

from ament_index_python import get_resources

from sim.ros.messages.codec import message_class
from sim.ros.messages.type_definitions import installed_file
from sim.ros2.group import Group, argument, flag
from sim.ros2.interface_types import KINDS, interfaces, types_in_package
from sim.ros2.system import CliError, Output
from sim.suggestions import closest_match

interface = Group("interface", "Types of messages, services and actions")
ONLY = (
    flag("-m", "--only-msgs", help="Only message types"),
    flag("-s", "--only-srvs", help="Only service types"),
    flag("-a", "--only-actions", help="Only action types"),
)
TYPE = argument(
    "type",
    help="The interface (e.g. 'example_interfaces/msg/String')",
    completer=lambda *_: [name for kind in KINDS for name in interfaces(kind)],
)
PARTS = 3  # of a type's name
INTEGERS = [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
PRIMITIVES = {"bool", "byte", "char", "float32", "float64", "string", "wstring", *INTEGERS}
LINE = re.compile(
    r"(?P<type>[\w/]+)(?:<=\d+)?(?:\[[^]]*\])?\s+\w+"
)  # a definition's line that declares a field


def _kinds(options: Namespace) -> list[str]:
    chosen = {"msg": options.only_msgs, "srv": options.only_srvs, "action": options.only_actions}
    return [kind for kind, selected in chosen.items() if selected] or list(KINDS)


@interface.verb("list", *ONLY, without_system=True)
def list_(output: Output, options: Namespace) -> None:
    """List all interface types available."""
    for kind in _kinds(options):
        output.print_line("\n".join([f"{KINDS[kind]}:", *(f"    {name}" for name in interfaces(kind))]))


@interface.verb(
    "package",
    *ONLY,
    argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')"),
    without_system=True,
)
def package(output: Output, options: Namespace) -> None:
    """Output a list of available interface types within one package."""
    for name in types_in_package(options.package_name, *_kinds(options)):
        output.print_line(name)


@interface.verb("packages", *ONLY, without_system=True)
def packages(output: Output, options: Namespace) -> None:
    """Output a list of packages that provide interfaces."""
    kinds = _kinds(options)
    for name in sorted(get_resources("rosidl_interfaces")):
        if types_in_package(name, *kinds):
            output.print_line(name)


@interface.verb(
    "proto",
    TYPE,
    flag("--no-quotes", help="Output has no outer quotes"),
    without_system=True,
)
def proto(output: Output, options: Namespace) -> None:
    """Output an interface prototype."""
    from sim.ros2.text import as_yaml  # imported late, because numpy is slow

    _lines(options.type)  # raises if there is no such type
    kind = message_class(options.type)
    part = {"srv": "Request", "action": "Goal"}.get(options.type.split("/")[1])
    text = as_yaml((getattr(kind, part) if part else kind)())
    output.print_line(text if options.no_quotes else f'"{text}"')


@interface.verb(
    "show",
    TYPE,
    flag("--all-comments", help="Show all comments, including for nested interface definitions"),
    flag("--no-comments", help="Show no comments or whitespace"),
    without_system=True,
)
def show(output: Output, options: Namespace) -> None:
    """Output the interface definition."""
    for line in _definition(options.type, comments=not options.no_comments, nested=options.all_comments):
        output.print_line(line)


def _definition(type_: str, *, comments: bool, nested: bool, depth: int = 0) -> Iterator[str]:
    """The lines of a definition; below each field of a message type, those of its definition."""
    for line in _lines(type_):
        text, _, comment = line.partition("#")
        shown = line.rstrip() if comments else text.rstrip()
        if shown:
            yield "\t" * depth + shown
        elif comments and not comment:
            yield ""
        inner = _message_type(text, type_.split("/")[0])
        if inner:
            yield from _definition(inner, comments=nested, nested=nested, depth=depth + 1)


def _lines(type_: str) -> list[str]:
    parts = type_.split("/")
    if len(parts) != PARTS:
        raise CliError(f"Invalid name '{type_}'. Expected three parts separated by '/'{_near(type_)}")
    types_in_package(parts[0])  # raises if there is no such package
    path = installed_file(type_, parts[1])
    if not path.exists():
        raise CliError(f"Could not find the interface '{type_}'{_near(type_)}")
    return path.read_text(encoding="utf-8").splitlines()


def _near(type_: str) -> str:
    known = [name for kind in KINDS for name in interfaces(kind)]
    short = {name.rsplit("/", 1)[1]: name for name in known}
    near = short.get(type_.rsplit("/", 1)[-1]) or closest_match(type_, known)
    return f". Did you mean {near}?" if near else ""


def _message_type(text: str, package: str) -> str:
    """The message type of the field that a line declares, or an empty text."""
    match = LINE.match(text)
    if match is None or match["type"] in PRIMITIVES:
        return ""
    space, _, name = match["type"].rpartition("/")
    return f"{space.split('/')[0] or package}/msg/{name}"
