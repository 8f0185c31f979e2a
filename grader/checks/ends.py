"""The ends of topics, services and actions that nodes declare: are they there, and of which type."""

from __future__ import annotations

from typing import NamedTuple

from grader.checks.check import Missed
from sim.evidence import INFRASTRUCTURE_TOPICS, Endpoint, Recording
from sim.suggestions import closest_ros_name, describe_difference

# As messages they are nearly the same.
_FLOATS = {"std_msgs/msg/Float32", "std_msgs/msg/Float64"}


class _Words(NamedTuple):
    """How to speak of one kind of end. other: the kind at the far end."""

    other: str
    what: str
    type: str
    none: str
    instead: str


_WORDS = {
    "publisher": _Words("subscription", "topic", "message type", "no publisher there", "there is one on {}"),
    "subscription": _Words(
        "publisher", "topic", "message type", "no subscription there", "there is one to {}"
    ),
    "service": _Words("client", "service", "type", "no server for it", "there is one for {}"),
    "client": _Words("service", "service", "type", "no client for it", "there is one for {}"),
    "action server": _Words("action client", "action", "type", "no server for it", "there is one for {}"),
    "action client": _Words(
        "action server", "action", "type", "no client for it", "there is one for {}"
    ),
}


def declared(recording: Recording, kind: str, name: str, type: str, expected: str) -> list[Endpoint]:
    """The student's ends of this kind and name, all of one type if one is given. kind: as in `Endpoint`.

    Raises Missed with what there is in their place.
    """
    words, ends = _WORDS[kind], [end for end in recording.graph.ends(kind) if not end.from_course]
    found = [end for end in ends if end.name == name]
    wrong = next((end for end in found if type and end.type != type), None)
    if wrong:
        hint = f"Both ends of {_a(words.what)} must use the same {words.type}: on {name} it is {type}."
        typo = (wrong.type, type) if kind == "publisher" and {wrong.type, type} == _FLOATS else None
        raise Missed(expected, f"type {wrong.type} on {name}", hint, typo=typo)
    if not found:
        connected = {end.name for end in recording.graph.ends(words.other)}
        # a connected one is no typo
        others = sorted({end.name for end in ends} - INFRASTRUCTURE_TOPICS - connected)
        near = closest_ros_name(name, others)
        saw = words.none + (f"; {words.instead.format(', '.join(others))}" if others else "")
        hint, typo = (describe_difference(near, name), (near, name)) if near else ("", None)
        raise Missed(expected, saw, hint, typo=typo)
    return found


def _a(noun: str) -> str:
    return f"an {noun}" if noun[0] in "aeiou" else f"a {noun}"
