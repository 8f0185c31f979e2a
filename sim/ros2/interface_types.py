"""The installed interface types, and their classes."""

from __future__ import annotations

from typing import Any

from ament_index_python import get_resource, get_resources
from ament_index_python.resources import has_resource

from sim.ros.messages.codec import message_class
from sim.ros2.system import CliError
from sim.suggestions import closest_match

KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}


def interfaces(kind: str) -> list[str]:
    """All types of a kind, "msg", "srv" or "action", sorted, such as "std_msgs/msg/String"."""
    packages = get_resources("rosidl_interfaces")
    return sorted(name for package in packages for name in types_in_package(package, kind))


def types_in_package(package: str, *kinds: str) -> list[str]:
    """The types of these kinds in a package, sorted. Raises CliError if there is no such package."""
    if not has_resource("packages", package):
        packages = get_resources("rosidl_interfaces")
        near = closest_match(package, packages)
        raise CliError(f"Unknown package '{package}'" + (f". Did you mean {near}?" if near else ""))
    try:
        content, _ = get_resource("rosidl_interfaces", package)
    except LookupError:
        return []
    names = {line.rsplit(".", 1)[0] for line in content.splitlines() if "_" not in line}
    return sorted(f"{package}/{name}" for name in names if name.split("/")[0] in kinds)


def installed_type(name: str) -> str:
    """The name of a message type, unchanged. Raises CliError if the type is not installed."""
    try:
        message_class(name)
    except (ImportError, AttributeError, ValueError):
        raise CliError(f"The message type '{name}' is invalid") from None
    return name


def type_class(name: str, kind: str, failed: str) -> type[Any]:
    """The class of a type; its name may omit the kind. Raises CliError, whose text begins with `failed`."""
    parts = name.split("/")
    full = f"{parts[0]}/{kind}/{parts[1]}" if len(parts) == 2 else name
    known = interfaces(kind)
    if full not in known:
        near = closest_match(full, known)
        raise CliError(failed + (f". Did you mean {near}?" if near else ""))
    return message_class(full)
