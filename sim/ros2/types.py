"""The interface types that are installed, and their classes."""

from __future__ import annotations

from ament_index_python import get_resource, get_resources
from ament_index_python.resources import has_resource

from sim.ros.messages.codec import message_class
from sim.ros2.system import Wrong
from sim.suggestions import closest_match

KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}


def interfaces(kind: str) -> list[str]:
    """All types of a kind, "msg", "srv" or "action", sorted, such as "std_msgs/msg/String"."""
    packages = get_resources("rosidl_interfaces")
    return sorted(name for package in packages for name in of_package(package, kind))


def of_package(package: str, *kinds: str) -> list[str]:
    """The types of these kinds that one package has, sorted. Raises Wrong for a package that there is not."""
    if not has_resource("packages", package):
        packages = get_resources("rosidl_interfaces")
        near = closest_match(package, packages)
        raise Wrong(f"Unknown package '{package}'" + (f". Did you mean {near}?" if near else ""))
    try:
        content, _ = get_resource("rosidl_interfaces", package)
    except LookupError:
        return []
    names = {line.rsplit(".", 1)[0] for line in content.splitlines() if "_" not in line}
    return sorted(f"{package}/{name}" for name in names if name.split("/")[0] in kinds)


def existing(name: str) -> str:
    """The name of a message type. Raises Wrong where this machine doesn't have it."""
    try:
        message_class(name)
    except (ImportError, AttributeError, ValueError):
        raise Wrong(f"The message type '{name}' is invalid") from None
    return name


def type_of(name: str, kind: str, failed: str) -> type:
    """The class of a type, whose kind may be left out of its name. Raises Wrong that begins with `failed`."""
    parts = name.split("/")
    full = f"{parts[0]}/{kind}/{parts[1]}" if len(parts) == 2 else name
    known = interfaces(kind)
    if full not in known:
        near = closest_match(full, known)
        raise Wrong(failed + (f". Did you mean {near}?" if near else ""))
    return message_class(full)
