"""Validates everything that another process sends before any other code uses it."""

from __future__ import annotations

import functools
import re
import sys
from importlib.util import find_spec
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.type_support import check_for_type_support

from sim.ros.messages.cdr import Canonical, is_canonical
from sim.ros.messages.codec import encode, message_class, type_name
from sim.ros.messages.decoder import decode_message
from sim.ros.rclpy_cpp import cpp

MAX_TEXT_LENGTH = 20_000  # characters of a log line or another text; the rest is cut off
MAX_TOTAL_TEXT = 100_000_000  # characters of all texts of a run
MAX_STDERR_LENGTH = 100_000  # characters
MAX_QOS_DEPTH = 100_000  # of a queue
MAX_NAME_LENGTH = 255  # characters, as in ROS
MAX_CACHED_NAMES = 10_000  # names that are validated only once
_INTERFACE = re.compile(r"([a-z][a-z0-9_]*)/(msg|srv|action)/[A-Z][A-Za-z0-9]*")
_POLICIES = {
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "history": HistoryPolicy,
    "liveliness": LivelinessPolicy,
}
_DURATIONS = ("deadline", "lifespan", "liveliness_lease_duration")
_type_folders = [sys.prefix, sys.base_prefix]  # that students can't write to


class ProtocolError(Exception):
    """The other process sent something invalid. The message continues the sentence "it sent ..."."""


def valid_text(value: Any, what: str, max_length: int = MAX_TEXT_LENGTH) -> str:
    """A text, cut to a length and encodable as UTF-8. Raises ProtocolError if `value` is no text."""
    if not isinstance(value, str):
        raise ProtocolError(f"{what} that is not a text")
    short = value[:max_length]
    return short if short.isascii() else short.encode("utf-8", "replace").decode()


class TextBudget:
    """Validates the texts of one run and limits their total length."""

    def __init__(self) -> None:
        self._characters = 0
        self._names: dict[str, str] = {}

    def take(self, value: Any, what: str, max_length: int = MAX_TEXT_LENGTH) -> str:
        """The text, as `valid_text` returns it. Raises ProtocolError."""
        taken = valid_text(value, what, max_length)
        self._characters += len(taken)
        if self._characters > MAX_TOTAL_TEXT:
            raise ProtocolError(f"more than {MAX_TOTAL_TEXT} characters of log lines, names and other texts")
        return taken

    def name(self, value: Any, what: str) -> str:
        """A name. Names repeat, so each is validated and counted once. Raises ProtocolError."""
        known = self._names.get(value) if isinstance(value, str) else None
        if known is None:
            known = self.take(value, what, MAX_NAME_LENGTH)
            if len(self._names) < MAX_CACHED_NAMES:
                self._names[known] = known
        return known


def printable(text: str, max_length: int) -> str:
    """A text for an error message: on one line, cut to a length, without control characters."""
    return "".join(char if char.isprintable() else "?" for char in " ".join(text[:max_length].split()))


def valid_int(value: Any, what: str, low: int = 0, high: int = 2**63 - 1) -> int:
    """An integer from `low` to `high`."""
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise ProtocolError(f"{what} that is not an integer from {low} to {high}")
    return value


def valid_float(value: Any, what: str, low: float, high: float) -> float:
    """A number from `low` to `high`."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise ProtocolError(f"{what} that is not a number from {low:g} to {high:g}")
    return float(value)


def valid_list(value: Any, what: str, max_items: int, width: int = 0) -> list[Any]:
    """A list of at most `max_items` items. With a width, each item is a list of this length."""
    if not isinstance(value, list):
        raise ProtocolError(f"{what} that are not a list")
    if len(value) > max_items:
        raise ProtocolError(f"{len(value)} {what} at once; {max_items} are allowed")
    if width and any(not isinstance(row, list) or len(row) != width for row in value):
        raise ProtocolError(f"{what} that are not lists of {width}")
    return value


def valid_message(value: Any, cls: type, what: str) -> tuple[Any, bytes]:
    """The message of this class that the received bytes encode, and its bytes.

    The object is serialized again, so later readers see only bytes that ROS itself has written.
    """
    try:
        if not isinstance(value, bytes):
            raise TypeError("a message is bytes")
        decoded = decode_message(cls, value)
        return decoded, encode(decoded)
    except (TypeError, ValueError, cpp.RMWError):
        raise ProtocolError(f"{what} that is not of type {type_name(cls)}") from None


def valid_message_bytes(value: Any, cls: type, what: str) -> bytes:
    """Work like `valid_message`, but only for bytes. Canonical bytes are returned as they are."""
    if isinstance(value, bytes) and is_canonical(type_name(cls), value):
        return Canonical(value)
    return valid_message(value, cls, what)[1]


@functools.cache
def valid_interface(name: str, kind: str) -> type[Any]:
    """The class of an installed message, service or action: `kind` is "msg", "srv" or "action"."""
    match = _INTERFACE.fullmatch(name)
    if match is None or match[2] != kind:
        raise ProtocolError(f"the type {name[:100]!r}, which is not the name of a {kind} type")
    try:
        if not _is_installed(match[1]):
            raise ImportError
        cls = message_class(name)
        check_for_type_support(cls)
    except (ImportError, AttributeError, cpp.UnsupportedEventTypeError):
        raise ProtocolError(f"the type {name}, which is not installed here") from None
    return cls


def trust_types_in(folder: str) -> None:
    """Accept messages of types that are in this folder as well. For a judge it has nothing of a student's."""
    _type_folders.append(folder)


def _is_installed(package: str) -> bool:
    """Return whether a package is installed in this Python, not in a folder a student can write to."""
    spec = find_spec(package)
    folders = list(spec.submodule_search_locations or ()) if spec is not None else []
    return bool(folders) and all(folder.startswith(tuple(_type_folders)) for folder in folders)


def qos_to_list(profile: Any) -> list[int]:
    """A QoS profile as a list of numbers, for the wire."""
    return [
        profile.depth,
        *(int(getattr(profile, name)) for name in _POLICIES),
        *(getattr(profile, name).nanoseconds for name in _DURATIONS),
    ]


def valid_qos(value: Any) -> QoSProfile:
    """The QoS profile that `qos_to_list` made this list from. Raises ProtocolError."""
    depth, *numbers = valid_list(value, "a QoS profile", 1 + len(_POLICIES) + len(_DURATIONS))
    if len(numbers) != len(_POLICIES) + len(_DURATIONS):
        raise ProtocolError("an incomplete QoS profile")
    settings: dict[str, Any] = {"depth": valid_int(depth, "a depth", 0, MAX_QOS_DEPTH)}
    for (name, policy), chosen in zip(_POLICIES.items(), numbers, strict=False):
        try:
            settings[name] = policy(valid_int(chosen, f"a {name}"))
        except ValueError:
            raise ProtocolError(f"the unknown {name} {chosen}") from None
    for name, length in zip(_DURATIONS, numbers[len(_POLICIES) :], strict=True):
        settings[name] = Duration(nanoseconds=valid_int(length, f"a {name}"))
    return QoSProfile(**settings)
