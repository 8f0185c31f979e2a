"""Is it what it should be? What another process sends is looked at here before anything else sees it."""

from __future__ import annotations

import functools
import re
import sys
from importlib.util import find_spec
from typing import Any

from rclpy.duration import Duration
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.type_support import check_for_type_support

from sim.ros.messages.cdr import Canonical, is_canonical
from sim.ros.messages.codec import encode, message_class, type_name
from sim.ros.messages.decoder import decode_message

MOST_TEXT = 20_000  # characters of a log line and the like that are kept
ALL_TEXT = 100_000_000  # characters of log lines, names and the like in a run
MOST_WRITTEN = 100_000  # characters on stderr
MOST_DEPTH = 100_000  # of a queue
MOST_NAME = 255  # characters, as in ROS
MOST_KNOWN = 10_000  # names that are known again
_INTERFACE = re.compile(r"([a-z][a-z0-9_]*)/(msg|srv|action)/[A-Z][A-Za-z0-9]*")
_POLICIES = {
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "history": HistoryPolicy,
    "liveliness": LivelinessPolicy,
}
_DURATIONS = ("deadline", "lifespan", "liveliness_lease_duration")


class Nonsense(Exception):
    """Something that came can't be so. The text goes on a sentence: "it sent ..."."""


def text(value: Any, what: str, most: int = MOST_TEXT) -> str:
    """A text, cut to so many characters, that can be written to any file."""
    if not isinstance(value, str):
        raise Nonsense(f"{what} that is no text")
    short = value[:most]
    return short if short.isascii() else short.encode("utf-8", "replace").decode()


class Texts:
    """The texts of a run: as `text`, and all together have a limit."""

    def __init__(self) -> None:
        self._characters = 0
        self._names: dict[str, str] = {}

    def take(self, value: Any, what: str, most: int = MOST_TEXT) -> str:
        """The next one. Raises Nonsense."""
        taken = text(value, what, most)
        self._characters += len(taken)
        if self._characters > ALL_TEXT:
            raise Nonsense(f"more than {ALL_TEXT} characters of log lines, names and the like")
        return taken

    def name(self, value: Any, what: str) -> str:
        """A name. The same come again and again: each is looked at, and counts, once. Raises Nonsense."""
        known = self._names.get(value) if isinstance(value, str) else None
        if known is None:
            known = self.take(value, what, MOST_NAME)
            if len(self._names) < MOST_KNOWN:
                self._names[known] = known
        return known


def printable(words: str, most: int) -> str:
    """Words for a sentence of ours: on one line, cut to so many characters, harmless to a terminal."""
    return "".join(letter if letter.isprintable() else "?" for letter in " ".join(words[:most].split()))


def whole(value: Any, what: str, low: int = 0, high: int = 2**63 - 1) -> int:
    """A whole number from `low` to `high`."""
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise Nonsense(f"{what} that is no whole number from {low} to {high}")
    return value


def number(value: Any, what: str, low: float, high: float) -> float:
    """A number from `low` to `high`."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise Nonsense(f"{what} that is not a number from {low:g} to {high:g}")
    return float(value)


def rows(value: Any, what: str, most: int, width: int = 0) -> list[Any]:
    """A list of at most so many things; with a width, of lists of this length."""
    if not isinstance(value, list):
        raise Nonsense(f"{what} that are no list")
    if len(value) > most:
        raise Nonsense(f"{len(value)} {what} at once; {most} are allowed")
    if width and any(not isinstance(row, list) or len(row) != width for row in value):
        raise Nonsense(f"{what} that are not lists of {width}")
    return value


def message(value: Any, cls: type, what: str) -> tuple[Any, bytes]:
    """A message object of this class and its bytes, from bytes that came.

    Its bytes are written anew from the object, so whatever reads them reads what ROS itself has written.
    """
    try:
        if not isinstance(value, bytes):
            raise TypeError("a message is bytes")
        found = decode_message(cls, value)
        return found, encode(found)
    except (TypeError, ValueError, _rclpy.RMWError):
        raise Nonsense(f"{what} that is no {type_name(cls)}") from None


def message_bytes(value: Any, cls: type, what: str) -> bytes:
    """As `message`, the bytes alone: where they are what ROS would write, nothing has to be written."""
    if isinstance(value, bytes) and is_canonical(type_name(cls), value):
        return Canonical(value)
    return message(value, cls, what)[1]


@functools.cache
def interface(name: str, kind: str) -> type:
    """The class of an installed message, service or action: `kind` is "msg", "srv" or "action"."""
    found = _INTERFACE.fullmatch(name)
    if found is None or found[2] != kind:
        raise Nonsense(f"the type {name[:100]!r}, which is no name of a {kind} type")
    try:
        if not _installed(found[1]):
            raise ImportError
        cls = message_class(name)
        check_for_type_support(cls)
    except (ImportError, AttributeError, _rclpy.UnsupportedEventTypeError):
        raise Nonsense(f"the type {name}, which is not installed here") from None
    return cls


def _installed(package: str) -> bool:
    """Whether a package lies in this Python's own folders, and not where a student could put one."""
    spec = find_spec(package)
    places = list(spec.submodule_search_locations or ()) if spec is not None else []
    return bool(places) and all(place.startswith((sys.prefix, sys.base_prefix)) for place in places)


def plain_qos(profile: Any) -> list[int]:
    """A QoS profile as numbers."""
    return [
        profile.depth,
        *(int(getattr(profile, name)) for name in _POLICIES),
        *(getattr(profile, name).nanoseconds for name in _DURATIONS),
    ]


def qos(value: Any) -> QoSProfile:
    """The QoS profile of these numbers."""
    depth, *numbers = rows(value, "a QoS profile", 1 + len(_POLICIES) + len(_DURATIONS))
    if len(numbers) != len(_POLICIES) + len(_DURATIONS):
        raise Nonsense("a QoS profile with parts missing")
    settings: dict[str, Any] = {"depth": whole(depth, "a depth", 0, MOST_DEPTH)}
    for (name, policy), chosen in zip(_POLICIES.items(), numbers, strict=False):
        try:
            settings[name] = policy(whole(chosen, f"a {name}"))
        except ValueError:
            raise Nonsense(f"the {name} {chosen}, which there is none of") from None
    for name, length in zip(_DURATIONS, numbers[len(_POLICIES) :], strict=True):
        settings[name] = Duration(nanoseconds=whole(length, f"a {name}"))
    return QoSProfile(**settings)
