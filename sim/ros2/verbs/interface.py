"""ros2 interface: the types of messages, services and actions that are installed."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Iterator

from ament_index_python import get_resources

from sim.ros.messages.definitions import installed_file
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import Voice, Wrong
from sim.ros2.types import KINDS, interfaces, of_package
from sim.suggestions import closest_match

interface = Group("interface", "Types of messages, services and actions")
ONLY = (
    flag("-m", "--only-msgs", help="Only message types"),
    flag("-s", "--only-srvs", help="Only service types"),
    flag("-a", "--only-actions", help="Only action types"),
)
PARTS = 3  # of a type's name
INTEGERS = [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
PRIMITIVES = {"bool", "byte", "char", "float32", "float64", "string", "wstring", *INTEGERS}
LINE = re.compile(r"(?P<type>[\w/]+)(?:<=\d+)?(?:\[[^]]*\])?\s+\w+")  # of a definition that declares a field


def _kinds(asked: Namespace) -> list[str]:
    chosen = {"msg": asked.only_msgs, "srv": asked.only_srvs, "action": asked.only_actions}
    return [kind for kind, wanted in chosen.items() if wanted] or list(KINDS)


@interface.verb("list", *ONLY, alone=True)
def list_(voice: Voice, asked: Namespace) -> None:
    """List all interface types available."""
    for kind in _kinds(asked):
        voice.say("\n".join([f"{KINDS[kind]}:", *(f"    {name}" for name in interfaces(kind))]))


@interface.verb(
    "package",
    *ONLY,
    argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')"),
    alone=True,
)
def package(voice: Voice, asked: Namespace) -> None:
    """Output a list of available interface types within one package."""
    for name in of_package(asked.package_name, *_kinds(asked)):
        voice.say(name)


@interface.verb("packages", *ONLY, alone=True)
def packages(voice: Voice, asked: Namespace) -> None:
    """Output a list of packages that provide interfaces."""
    kinds = _kinds(asked)
    for name in sorted(get_resources("rosidl_interfaces")):
        if of_package(name, *kinds):
            voice.say(name)


@interface.verb(
    "show",
    argument(
        "type",
        help="The interface (e.g. 'example_interfaces/msg/String')",
        offers=lambda *_: [name for kind in KINDS for name in interfaces(kind)],
    ),
    flag("--all-comments", help="Show all comments, including for nested interface definitions"),
    flag("--no-comments", help="Show no comments or whitespace"),
    alone=True,
)
def show(voice: Voice, asked: Namespace) -> None:
    """Output the interface definition."""
    for line in _definition(asked.type, comments=not asked.no_comments, nested=asked.all_comments):
        voice.say(line)


def _definition(type_: str, *, comments: bool, nested: bool, depth: int = 0) -> Iterator[str]:
    """The lines of a definition, and below each field that is a message those of its own."""
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
        raise Wrong(f"Invalid name '{type_}'. Expected three parts separated by '/'{_near(type_)}")
    of_package(parts[0])  # raises where there is no such package
    path = installed_file(type_, parts[1])
    if not path.exists():
        raise Wrong(f"Could not find the interface '{type_}'{_near(type_)}")
    return path.read_text(encoding="utf-8").splitlines()


def _near(type_: str) -> str:
    known = [name for kind in KINDS for name in interfaces(kind)]
    short = {name.rsplit("/", 1)[1]: name for name in known}
    near = short.get(type_.rsplit("/", 1)[-1]) or closest_match(type_, known)
    return f". Did you mean {near}?" if near else ""


def _message_type(text: str, package: str) -> str:
    """The type of the field that a line declares, where that is a message; or nothing."""
    match = LINE.match(text)
    if match is None or match["type"] in PRIMITIVES:
        return ""
    space, _, name = match["type"].rpartition("/")
    return f"{space.split('/')[0] or package}/msg/{name}"
