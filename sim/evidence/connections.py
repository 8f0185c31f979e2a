"""Connections of a graph: which come about, and which don't, with the reason in words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sim.evidence.graph import Endpoint, Graph
from sim.evidence.qos import offer, refusal
from sim.suggestions import closest_ros_name, describe_difference

# Kinds of ends: who gives or answers, who takes or asks, and what lies between them.
SIDES = (
    ("publisher", "subscription", "topic"),
    ("service", "client", "service"),
    ("action server", "action client", "action"),
)
_SILENT = {
    "topic": "nobody publishes on {}",
    "service": "nobody offers the service {}",
    "action": "nobody offers the action {}",
}


class Missing(NamedTuple):
    """A connection that doesn't come about."""

    what: str  # topic, service or action
    given: Endpoint | None  # the end that gives; None where nobody does
    wanted: Endpoint  # the end that gets nothing
    reason: str  # a sentence

    @property
    def idle(self) -> bool:
        """Whether a node of the world, such as the robot, just isn't told anything: that is no mistake."""
        return self.given is None and self.wanted.ours


def missing(graph: Graph) -> list[Missing]:
    """Every end that takes or asks, and gets nothing of an end that gives: with each of these, the reason."""
    return [gap for sides in SIDES for gap in _gaps(graph, *sides)]


def _gaps(graph: Graph, giving: str, taking: str, what: str) -> Iterator[Missing]:
    offered, wishes = _once(graph.ends(giving)), _once(graph.ends(taking))
    asked_for = {end.name for end in wishes}
    lonely = {end.name: end for end in offered if end.name not in asked_for}
    for wanted in wishes:
        there = [end for end in offered if end.name == wanted.name]
        for given in there:
            reason = _misfit(given, wanted)
            if reason:
                yield Missing(what, given, wanted, reason)
        if not there:
            near = closest_ros_name(wanted.name, lonely)
            reason = f"{wanted.node} waits in vain: " + _SILENT[what].format(wanted.name)
            if near:
                reason += f", and {lonely[near].node} has {near}. {slip(lonely[near], wanted)}"
            yield Missing(what, lonely.get(near), wanted, reason if near else f"{reason}.")


def slip(given: Endpoint, wanted: Endpoint) -> str:
    """What makes the names of two ends differ, in a sentence: what isn't the student's is written rightly."""
    wrong, right = (wanted, given) if given.ours and not wanted.ours else (given, wanted)
    return describe_difference(wrong.name, right.name)


def _once(ends: list[Endpoint]) -> list[Endpoint]:
    """The ends without those that are quite like an earlier one."""
    return list({repr(end): end for end in ends}.values())


def _misfit(given: Endpoint, wanted: Endpoint) -> str:
    """Why two ends of one name don't connect, or nothing."""
    if given.type != wanted.type:
        return (
            f"{given.name} is {given.type} for {given.node}, and {wanted.type} for {wanted.node}: nothing"
            " arrives."
        )
    found = refusal(given.qos, wanted.qos)
    if found is None:
        return ""
    policy, offered, wish = found
    return (
        f"On {given.name} {given.node} publishes {offer(policy, offered)}, and {wanted.node} asks for"
        f" {wish}: nothing arrives."
    )
