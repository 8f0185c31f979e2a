"""ros2 topic: which topics there are, and who is at their ends."""

from __future__ import annotations

import json
from argparse import Namespace

from sim.evidence import Endpoint
from sim.ros.messages.definitions import installed_file
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import System, Wrong, guess

topic = Group("topic", "Topics: list, listen, measure, publish")
NAME = argument(
    "topic_name",
    help="Name of the ROS topic (e.g. '/chatter')",
    offers=lambda system, _: list(system.topics(hidden=True)),
)


def types_of(system: System, asked: Namespace) -> list[str]:
    """The types of the topic that was named, as far as somebody has it."""
    return system.topics(hidden=True).get(asked.topic_name, [])


HIDDEN = flag("--include-hidden-topics", help="Consider hidden topics as well")
COUNT = flag("-c", "--count-topics", help="Only display the number of topics discovered")
SIDES = {"publisher": "Published", "subscription": "Subscribed"}
WORDS = {"publisher": "publisher", "subscription": "subscriber"}


@topic.verb(
    "list",
    flag("-t", "--show-types", help="Additionally show the topic type"),
    COUNT,
    HIDDEN,
    flag("-v", "--verbose", help="List full details about each topic"),
)
def list_(system: System, asked: Namespace) -> None:
    """Output a list of available topics."""
    found = system.topics(hidden=asked.include_hidden_topics)
    if asked.count_topics:
        system.say(str(len(found)))
    elif asked.verbose:
        for kind, side in SIDES.items():
            ends = [end.name for end in system.ends if end.kind == kind]
            lines = [
                f" * {name} [{', '.join(types)}] {count} {WORDS[kind]}{'s' if count > 1 else ''}"
                for name, types in found.items()
                if (count := ends.count(name))
            ]
            system.say("\n".join([f"{side} topics:", *lines, ""]))
    else:
        for name, types in found.items():
            system.say(f"{name} [{', '.join(types)}]" if asked.show_types else name)


@topic.verb(
    "info",
    NAME,
    flag("-v", "--verbose", help="Also the nodes, type hashes and QoS profiles of both ends"),
)
def info(system: System, asked: Namespace) -> None:
    """Print information about a topic."""
    found = system.look_for(asked.topic_name, lambda: system.topics(hidden=True))
    if asked.topic_name not in found:
        raise Wrong(f"Unknown topic '{asked.topic_name}'{guess(asked.topic_name, found)}")
    gap = "\n" if asked.verbose else ""
    types = found[asked.topic_name]
    system.say(f"Type: {types[0] if len(types) == 1 else types}{gap}")
    for kind, word in (("publisher", "Publisher"), ("subscription", "Subscription")):
        ends = [end for end in system.ends if (end.kind, end.name) == (kind, asked.topic_name)]
        system.say(f"{word} count: {len(ends)}{gap}")
        for end in ends if asked.verbose else ():
            system.say(_described(end) + gap)


def _described(end: Endpoint) -> str:
    space, _, name = end.node.rpartition("/")
    qos = end.qos
    history = qos.get("history", "unknown").upper()
    depth = f" ({qos['depth']})" if history == "KEEP_LAST" else ""
    lines = [
        f"Node name: {name}",
        f"Node namespace: {space or '/'}",
        f"Topic type: {end.type}",
        f"Topic type hash: {_type_hash(end.type)}",
        f"Endpoint type: {end.kind.upper()}",
        *([f"GID: {qos['gid']}"] if "gid" in qos else []),
        "QoS profile:",
        f"  Reliability: {qos.get('reliability', 'reliable').upper()}",
        f"  History (Depth): {history}{depth}",
        f"  Durability: {qos.get('durability', 'volatile').upper()}",
        f"  Lifespan: {_duration(qos.get('lifespan'))}",
        f"  Deadline: {_duration(qos.get('deadline'))}",
        f"  Liveliness: {qos.get('liveliness', 'automatic').upper()}",
        f"  Liveliness lease duration: {_duration(qos.get('liveliness_lease_duration'))}",
    ]
    return "\n".join(lines)


def _duration(seconds: float | None) -> str:
    return "Infinite" if seconds is None else f"{round(seconds * 1e9)} nanoseconds"


def _type_hash(type_: str) -> str:
    try:
        hashes = json.loads(installed_file(type_, "json").read_text())["type_hashes"]
    except (LookupError, OSError):  # a type that this machine doesn't have
        return "INVALID"
    return next((one["hash_string"] for one in hashes if one["type_name"] == type_), "INVALID")


@topic.verb("type", NAME, HIDDEN)
def type_(system: System, asked: Namespace) -> None:
    """Print a topic's type."""
    found = system.look_for(asked.topic_name, lambda: system.topics(hidden=True))
    if asked.topic_name not in found:
        near = guess(asked.topic_name, found)
        raise Wrong(f"Unknown topic '{asked.topic_name}'{near}")
    for name in found[asked.topic_name]:
        system.say(name)


@topic.verb("find", argument("topic_type", help="Topic type to filter for, package/msg/Name"), COUNT, HIDDEN)
def find(system: System, asked: Namespace) -> None:
    """Output a list of available topics of a given type."""
    topics = system.topics(hidden=asked.include_hidden_topics)
    found = [name for name, types in topics.items() if asked.topic_type in types]
    for line in [str(len(found))] if asked.count_topics else found:
        system.say(line)
