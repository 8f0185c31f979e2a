"""Connections of a graph: which come about, and which don't, with the reason in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sim.evidence.graph import Endpoint, Graph
from sim.evidence.qos import offer, refusal
from sim.evidence.rows import CLI_NAME
from sim.suggestions import closest_ros_name, describe_difference

# Kinds of ends: the offering one, the requesting one, and what connects them.
SIDES = (
    ("publisher", "subscription", "topic"),
    ("service", "client", "service"),
    ("action server", "action client", "action"),
)
# What a requesting end lacks, and what the node with a similar name does.
_SILENT = {
    "topic": ("{} receives nothing: no node publishes on {}", "publishes on"),
    "service": ("{} gets no response: no node offers the service {}", "offers"),
    "action": ("{} gets no response: no node offers the action {}", "offers"),
}


class Missing(NamedTuple):
    """A connection that is not made."""

    what: str  # topic, service or action
    given: Endpoint | None  # the offering end; None if there is none
    wanted: Endpoint  # the requesting end, which receives nothing
    reason: str  # a sentence

    @property
    def idle(self) -> bool:
        """Return whether a node of the course, such as the robot, merely receives nothing: no mistake."""
        return self.given is None and self.wanted.from_course


def missing(graph: Graph) -> list[Missing]:
    """Return every requesting end that receives nothing from an offering end, with the reason."""
    return [gap for sides in SIDES for gap in _gaps(graph, *sides)]


def _gaps(graph: Graph, giving: str, taking: str, what: str) -> Iterator[Missing]:
    offered, requested = _once(graph.ends(giving)), _once(graph.ends(taking))
    requested_names = {end.name for end in requested}
    lonely = {end.name: end for end in offered if end.name not in requested_names}
    for wanted in requested:
        there = [end for end in offered if end.name == wanted.name]
        for given in there:
            reason = _misfit(given, wanted)
            if reason:
                yield Missing(what, given, wanted, reason)
        if not there:
            near = closest_ros_name(wanted.name, lonely)
            lacking, does = _SILENT[what]
            reason = lacking.format(wanted.node, wanted.name)
            if near:
                reason += f", but {lonely[near].node} {does} {near}. {name_difference(lonely[near], wanted)}"
            yield Missing(what, lonely.get(near), wanted, reason if near else f"{reason}.")


def name_difference(given: Endpoint, wanted: Endpoint) -> str:
    """Return a sentence on how the names of two ends differ.

    The name in a program of the course is right, and that in a ros2 command is wrong.
    """
    is_typed = wanted.node.startswith(f"/{CLI_NAME}")
    wanted_is_wrong = is_typed or (given.from_course and not wanted.from_course)
    wrong, right = (wanted, given) if wanted_is_wrong else (given, wanted)
    return describe_difference(wrong.name, right.name)


def _once(ends: list[Endpoint]) -> list[Endpoint]:
    """Return the ends without repetitions of an equal one."""
    return list({repr(end): end for end in ends}.values())


def _misfit(given: Endpoint, wanted: Endpoint) -> str:
    """Return why two ends of one name don't connect, or nothing."""
    if given.type != wanted.type:
        return (
            f"{given.name} has type {given.type} in {given.node} and {wanted.type} in {wanted.node}: nothing"
            " arrives."
        )
    found = refusal(given.qos, wanted.qos)
    if found is None:
        return ""
    policy, offered, requested = found
    return (
        f"On {given.name} {given.node} publishes {offer(policy, offered)}, and {wanted.node} requests"
        f" {requested}: nothing arrives."
    )
