"""The classes of messages, services and actions, by names such as "std_msgs/msg/String"."""

from __future__ import annotations

import importlib
from typing import Any

KINDS = {"msg": "message", "srv": "service", "action": "action"}


def get_interface(identifier: str) -> Any:
    """The class of a message, service or action. Raises ValueError, ModuleNotFoundError, AttributeError."""
    parts = identifier.split("/")
    if len(parts) != 3 or parts[1] not in KINDS or not all(parts):
        raise ValueError(f"Expected the full name of an interface, got '{identifier}'")
    return getattr(importlib.import_module(".".join(parts[:2])), parts[2])


def is_message(interface: Any) -> bool:
    """Return whether a class is a message."""
    return hasattr(interface, "get_fields_and_field_types")


def is_service(interface: Any) -> bool:
    """Return whether a class is a service."""
    return hasattr(interface, "Request") and hasattr(interface, "Response")


def is_action(interface: Any) -> bool:
    """Return whether a class is an action."""
    return all(hasattr(interface, part) for part in ("Goal", "Result", "Feedback"))


def get_message(identifier: str) -> Any:
    """The class of a message. Raises as `get_interface`."""
    return _checked(identifier, is_message, "a message")


def get_service(identifier: str) -> Any:
    """The class of a service. Raises as `get_interface`."""
    return _checked(identifier, is_service, "a service")


def get_action(identifier: str) -> Any:
    """The class of an action. Raises as `get_interface`."""
    return _checked(identifier, is_action, "an action")


def _checked(identifier: str, is_kind: Any, kind: str) -> Any:
    interface = get_interface(identifier)
    if not is_kind(interface):
        raise ValueError(f"Expected the full name of {kind}, got '{identifier}'")
    return interface
