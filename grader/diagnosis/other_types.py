"""Two message types on one topic: which topic it is, who uses it, and the two types."""

from __future__ import annotations

import re
from typing import NamedTuple

from sim.evidence import CallbackError, Endpoint, Recording

_CLASH = re.compile(
    r"create_\w+\(\) called for existing topic name rt(/\S+) "
    r"with incompatible type (\w+)::(\w+)::dds_::(\w+)_"
)
_WITHOUT_WORDS = "Failed to create subscription: invalid allocator"


class Conflict(NamedTuple):
    """An end of a topic that could not be made, as another end has another type."""

    type: str
    other: Endpoint


def conflict(error: CallbackError, recording: Recording) -> Conflict | None:
    """The two types on one topic that an error is about; None for any other error."""
    found = _CLASH.search(words_of(error, recording))
    if found is None:
        return None
    topic, wanted = found[1], "/".join(found.groups()[1:])
    ends = (end for end in recording.graph.endpoints if end.name == topic and end.type != wanted)
    other = next((end for end in ends if end.kind in ("publisher", "subscription")), None)
    return other and Conflict(wanted, other)


def other_type(error: CallbackError, recording: Recording) -> str:
    """Return what to do about an end of a topic that carries another type already; "" for any other error."""
    found = conflict(error, recording)
    if found is None:
        return ""
    does = "publishes on" if found.other.kind == "publisher" else "subscribes to"
    return (
        f"{found.other.node} {does} {found.other.name} with the type {found.other.type}, but here it is "
        f"{found.type}: both ends of a topic must use the same type."
    )


def words_of(error: CallbackError, recording: Recording) -> str:
    """Return what an error says. If rcl lost the reason, "invalid allocator", it is still on stderr."""
    lost = list(_CLASH.finditer(recording.stderr)) if _WITHOUT_WORDS in error.text else []
    return lost[-1][0] if lost else error.text
