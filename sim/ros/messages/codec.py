"""Names and classes of message types, and serialization to CDR, the format that ROS sends."""

from __future__ import annotations

import functools
import importlib
from typing import Any

from rclpy.serialization import serialize_message


@functools.cache
def type_name(message_class: type) -> str:
    """ROS's name for a message, service or action class, e.g. "std_msgs/msg/String"."""
    package, kind = message_class.__module__.split(".")[:2]
    return f"{package}/{kind}/{message_class.__name__}"


@functools.cache
def message_class(name: str) -> type[Any]:
    """The class of that name, e.g. "std_msgs/msg/String" or "std_srvs/srv/SetBool_Request".

    Raises ImportError or AttributeError if there is none.
    """
    package, kind, short = name.split("/")
    module = importlib.import_module(f"{package}.{kind}")
    whole, _, part = short.partition("_")  # type names themselves have no underscore
    if part:  # of a service or action; the package does not export all of an action's
        module = importlib.import_module(getattr(module, whole).__module__)
    return getattr(module, short)


def encode(message: Any) -> bytes:
    """The serialized bytes of a message."""
    return serialize_message(message)


def expect(message: Any, wanted: type) -> None:
    """Raise a TypeError for a message of another type, as rclpy does, but with a text."""
    if not isinstance(message, wanted):
        raise TypeError(f"Expected {wanted}, got {type(message)}")
