"""Names of topics, services and actions that nearly match."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Iterable, Iterator

from grader.diagnosis.bundled import bundled_nodes
from sim.evidence import INFRASTRUCTURE_TOPICS, NAMELESS, Endpoint, Graph, Recording
from sim.evidence.connections import name_difference
from sim.suggestions import NAME_CUTOFF, closest_match, closest_ros_name

# Kinds of ends that take something, each with the kind that gives it.
_TAKERS = (("subscription", "publisher"), ("client", "service"), ("action client", "action server"))
OTHER_WORD = 0.5  # similarity below which two words are no typos of each other
PAIRS = (
    "start stop, on off, input output, inner outer, source target, global local, ping pong, enable disable, "
    "increase decrease, increment decrement, lock unlock, load unload, set get, set reset, request response, "
    "connected disconnected, internal external, upper lower, minimum maximum, width height, weight height, "
    "send receive"
)
OPPOSITES = [set(pair.split()) for pair in PAIRS.split(", ")]


def shared_name(recording: Recording) -> str:
    """A node of the student's with the name of one that the exercise or the world brings along."""
    shared = recording.shared - bundled_nodes(recording)  # such as turtlesim, which a launch file may start
    if not shared:
        return ""
    name = min(shared)
    return (
        f"Two nodes are called {name}, yours and one that takes part in this exercise, and ROS can't tell "
        "them apart: give yours a name of its own, in super().__init__('...')."
    )


def silent_rosout(recording: Recording) -> str:
    """A node whose log lines are not on /rosout, because another one of its name and program is gone."""
    for row in recording.node_facts:
        logger = row.node.strip("/").replace("/", ".")
        later = (line for line in recording.logs if line.node == logger and line.stamp > row.stamp)
        if row.fact == NAMELESS and any(later):
            return (
                f"Two nodes of one program were called {row.node}, and one of them was destroyed at "
                f"{row.stamp:.3g} s: ROS then takes the name off /rosout, and what the other one logs no "
                "longer arrives there. Give each node a name of its own, in super().__init__('...')."
            )
    return ""


def topic_name_typo(
    recording: Recording, holds: Callable[[Endpoint, Endpoint], bool] = lambda given, wanted: True
) -> str:
    """A topic with only publishers and one with only subscriptions, whose names are nearly the same.

    Between the course's programs it is what the exercise is about. holds: asked of both ends, in addition.
    """
    published = {e.name: e for e in recording.graph.publishers() if e.name not in INFRASTRUCTURE_TOPICS}
    subscribed = {e.name: e for e in recording.graph.subscriptions() if e.name not in INFRASTRUCTURE_TOPICS}
    for name, near in _nearly_met(subscribed, published):
        if _may_be_typo(published[near], subscribed[name]) and holds(published[near], subscribed[name]):
            return (
                f"{published[near].node} publishes on {near}, {subscribed[name].node} subscribes to {name}: "
                f"two different topics. {name_difference(published[near], subscribed[name])}"
            )
    return ""


def certain_topic_typo(recording: Recording) -> str:
    """The same, but for names of which one is the other with more words, as /cmd_vel and /cmd_vel_raw are.

    The second may be a deliberate name, for a node that takes no part in the run.
    """
    return topic_name_typo(recording, _has_no_more_words)


def _has_no_more_words(given: Endpoint, wanted: Endpoint) -> bool:
    one, other = ({*end.name.rsplit("/", 1)[-1].lower().split("_"), ""} for end in (given, wanted))
    return not (one < other or other < one)


def service_name_typo(recording: Recording) -> str:
    """A client for something that no node offers, with nearly the name of something that is offered."""
    for kind, client_kind, what in (
        ("service", "client", "services"),
        ("action server", "action client", "actions"),
    ):
        offered = {end.name: end for end in recording.graph.ends(kind)}
        wanted = {end.name: end for end in recording.graph.ends(client_kind)}
        for name, near in _nearly_met(wanted, offered):
            given, asked = offered[near], wanted[name]
            if not _may_be_typo(given, asked):
                continue
            return (
                f"{asked.node} calls {name}, {given.node} offers {near}: two different {what}. "
                f"{name_difference(given, asked)}"
            )
    return ""


def _may_be_typo(given: Endpoint, wanted: Endpoint) -> bool:
    """Return whether two ends of nearly the same name were meant to meet.

    Not two of the course's, nor two of one node, which passes something on, nor two that differ in type,
    or only in numbers or in words such as left and right, as those of two robots do.
    """
    if given.from_course and wanted.from_course:
        return False
    numbered = re.sub(r"\d+", "0", given.name) == re.sub(r"\d+", "0", wanted.name)
    students = not given.from_course and not wanted.from_course
    apart = students and (numbered or _are_other_words(given.name, wanted.name))
    return given.node != wanted.node and given.type == wanted.type and not apart


def _are_other_words(one: str, other: str) -> bool:
    """Return whether two names differ only in whole words, none of which is a typo of its counterpart."""
    pairs = [re.split("[/_]", name) for name in (one, other)]
    if len(pairs[0]) != len(pairs[1]):
        return False
    differing = [pair for pair in zip(*pairs, strict=True) if pair[0] != pair[1]]
    return any(set(pair) in OPPOSITES or _similarity(*pair) < OTHER_WORD for pair in differing)


def _similarity(one: str, other: str) -> float:
    return difflib.SequenceMatcher(None, one, other, autojunk=False).ratio()


def misspelt(recording: Recording) -> list[tuple[str, str]]:
    """Names in a student's program that match no other node, each with the one that was probably meant.

    Another namespace is no misspelling.
    """
    return sorted(pair for kinds in _TAKERS for pair in _misspelt(recording.graph, *kinds))


def _misspelt(graph: Graph, taker: str, giver: str) -> Iterator[tuple[str, str]]:
    wanted, offered = graph.ends(taker), graph.ends(giver)
    lonely = (
        {end.name for end in offered if end.from_course}
        - {end.name for end in wanted}
        - INFRASTRUCTURE_TOPICS
    )
    for name in {end.name for end in wanted if not end.from_course} - {end.name for end in offered}:
        near = closest_match(name, lonely, NAME_CUTOFF)
        if near and near.rsplit("/", 1)[-1] != name.rsplit("/", 1)[-1]:
            yield name, near


def _nearly_met(wanted: Iterable[str], offered: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Names that are wanted and not offered, each with the like one that is offered and not wanted."""
    lonely = [name for name in offered if name not in wanted]
    for name in wanted:
        near = closest_ros_name(name, lonely) if name not in offered else ""
        if near:
            yield name, near
