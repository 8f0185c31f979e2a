"""Names and classes of messages, and messages to bytes: CDR, the format that ROS sends."""

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
def message_class(name: str) -> type:
    """The class of that name, e.g. "std_msgs/msg/String" or "std_srvs/srv/SetBool_Request".

    Raises ImportError or AttributeError for none.
    """
    package, kind, short = name.split("/")
    module = importlib.import_module(f"{package}.{kind}")
    whole, _, part = short.partition("_")  # a name of ROS's own has no underscore
    if part:  # of a service or an action; the package hides some of an action's
        module = importlib.import_module(getattr(module, whole).__module__)
    return getattr(module, short)


def encode(message: Any) -> bytes:
    """The bytes of a message as they are sent."""
    return serialize_message(message)


def expect(message: Any, wanted: type) -> None:
    """Raise the TypeError that rclpy raises for a message of another type; but rclpy's has no words."""
    if not isinstance(message, wanted):
        raise TypeError(f"Expected {wanted}, got {type(message)}")
