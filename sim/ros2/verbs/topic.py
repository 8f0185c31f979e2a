"""ros2 topic: list topics, and print their endpoints."""

from __future__ import annotations

import json
from argparse import Namespace

from sim.evidence import Endpoint
from sim.ros.messages.type_definitions import installed_file
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import CliError, System, suggestion

topic = Group("topic", "Topics: list, echo, measure, publish")
NAME = argument(
    "topic_name",
    help="Name of the ROS topic (e.g. '/chatter')",
    completer=lambda system, _: list(system.topics(hidden=True)),
)


def types_of(system: System, options: Namespace) -> list[str]:
    """The types of the topic in the options, if it exists."""
    return system.topics(hidden=True).get(options.topic_name, [])


HIDDEN = flag("--include-hidden-topics", help="Consider hidden topics as well")
COUNT = flag("-c", "--count-topics", help="Only display the number of topics discovered")
TITLES = {"publisher": "Published", "subscription": "Subscribed"}
NOUNS = {"publisher": "publisher", "subscription": "subscriber"}


@topic.verb(
    "list",
    flag("-t", "--show-types", help="Additionally show the topic type"),
    COUNT,
    HIDDEN,
    flag("-v", "--verbose", help="List full details about each topic"),
)
def list_(system: System, options: Namespace) -> None:
    """Output a list of available topics."""
    found = system.topics(hidden=options.include_hidden_topics)
    if options.count_topics:
        system.print_line(str(len(found)))
    elif options.verbose:
        for kind, title in TITLES.items():
            endpoints = [end.name for end in system.endpoints if end.kind == kind]
            lines = [
                f" * {name} [{', '.join(types)}] {count} {NOUNS[kind]}{'s' if count > 1 else ''}"
                for name, types in found.items()
                if (count := endpoints.count(name))
            ]
            system.print_line("\n".join([f"{title} topics:", *lines, ""]))
    else:
        for name, types in found.items():
            system.print_line(f"{name} [{', '.join(types)}]" if options.show_types else name)


@topic.verb(
    "info",
    NAME,
    flag("-v", "--verbose", help="Also the nodes, type hashes and QoS profiles of both ends"),
)
def info(system: System, options: Namespace) -> None:
    """Print information about a topic."""
    found = system.look_up(options.topic_name, lambda: system.topics(hidden=True))
    if options.topic_name not in found:
        raise CliError(f"Unknown topic '{options.topic_name}'{suggestion(options.topic_name, found)}")
    gap = "\n" if options.verbose else ""
    types = found[options.topic_name]
    system.print_line(f"Type: {types[0] if len(types) == 1 else types}{gap}")
    for kind, title in (("publisher", "Publisher"), ("subscription", "Subscription")):
        endpoints = [end for end in system.endpoints if (end.kind, end.name) == (kind, options.topic_name)]
        system.print_line(f"{title} count: {len(endpoints)}{gap}")
        for end in endpoints if options.verbose else ():
            system.print_line(_format(end) + gap)


def _format(end: Endpoint) -> str:
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
    except (LookupError, OSError):  # the type is not installed
        return "INVALID"
    return next((each["hash_string"] for each in hashes if each["type_name"] == type_), "INVALID")


@topic.verb("type", NAME, HIDDEN)
def type_(system: System, options: Namespace) -> None:
    """Print a topic's type."""
    found = system.look_up(options.topic_name, lambda: system.topics(hidden=True))
    if options.topic_name not in found:
        near = suggestion(options.topic_name, found)
        raise CliError(f"Unknown topic '{options.topic_name}'{near}")
    for name in found[options.topic_name]:
        system.print_line(name)


@topic.verb("find", argument("topic_type", help="Topic type to filter for, package/msg/Name"), COUNT, HIDDEN)
def find(system: System, options: Namespace) -> None:
    """Output a list of available topics of a given type."""
    topics = system.topics(hidden=options.include_hidden_topics)
    found = [name for name, types in topics.items() if options.topic_type in types]
    for line in [str(len(found))] if options.count_topics else found:
        system.print_line(line)
