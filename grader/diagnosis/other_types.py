"""Two message types on one topic: which topic it is, who uses it, and the two types."""

from __future__ import annotations

import re

from sim.evidence import CallbackError, Recording

_CLASH = re.compile(
    r"create_\w+\(\) called for existing topic name rt(/\S+) "
    r"with incompatible type (\w+)::(\w+)::dds_::(\w+)_"
)
_WITHOUT_WORDS = "Failed to create subscription: invalid allocator"


def other_type(error: CallbackError, recording: Recording) -> str:
    """What to do about an end of a topic that carries another type already; "" for any other error."""
    found = _CLASH.search(words_of(error, recording))
    if found is None:
        return ""
    topic, wanted = found[1], "/".join(found.groups()[1:])
    ends = (end for end in recording.graph.endpoints if end.name == topic and end.type != wanted)
    other = next((end for end in ends if end.kind in ("publisher", "subscription")), None)
    if other is None:
        return ""
    does = "publishes" if other.kind == "publisher" else "listens to"
    return (
        f"{other.node} {does} {other.type} on {topic}, and here it is {wanted}: "
        "both ends of a topic must use the same type."
    )


def words_of(error: CallbackError, recording: Recording) -> str:
    """What an error says. Where rcl lost the reason and says "invalid allocator", it is still on stderr."""
    lost = list(_CLASH.finditer(recording.stderr)) if _WITHOUT_WORDS in error.text else []
    return lost[-1][0] if lost else error.text
