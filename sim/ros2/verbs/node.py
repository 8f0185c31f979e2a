"""ros2 node: which nodes there are, and how each is connected."""

from __future__ import annotations

from argparse import Namespace

from sim.ros2.group import Group, argument, flag
from sim.ros2.system import System, Wrong, guess, is_hidden

node = Group("node", "Nodes: which there are, and how each is connected")
SECTIONS = {
    "Subscribers": "subscription",
    "Publishers": "publisher",
    "Service Servers": "service",
    "Service Clients": "client",
    "Action Servers": "action server",
    "Action Clients": "action client",
}


@node.verb(
    "list",
    flag("-a", "--all", help="Display all nodes even hidden ones"),
    flag("-c", "--count-nodes", help="Only display the number of nodes discovered"),
)
def list_(system: System, asked: Namespace) -> None:
    """Output a list of available nodes."""
    names = sorted(name for name in system.nodes if asked.all or not is_hidden(name))
    if asked.count_nodes:
        system.say(str(len(names)))
        return
    if len(set(names)) < len(names):
        system.say(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, which can have"
            " unintended side effects."
        )
    for name in names:
        system.say(name)


@node.verb(
    "info",
    argument("node_name", help="Node name to request information", offers=lambda system, _: system.nodes),
    flag("--include-hidden", help="Display hidden topics, services, and actions as well"),
)
def info(system: System, asked: Namespace) -> None:
    """Output information about a node."""
    known = [name for name in system.nodes if asked.include_hidden or not is_hidden(name)]
    name = asked.node_name
    count = known.count(name)
    if not count:
        raise Wrong(f"Unable to find node '{name}'{guess(name, known)}")
    if count > 1:
        system.say(
            f'There are {count} nodes in the graph with the exact name "{name}". You are seeing information'
            " about only one of them."
        )
    system.say(name)
    ends = [end for end in system.ends if end.node == name]
    for title, kind in SECTIONS.items():
        shown = {end.name: end.type for end in ends if end.kind == kind}
        lines = [
            f"    {end}: {type_}"
            for end, type_ in sorted(shown.items())
            if asked.include_hidden or not is_hidden(end)
        ]
        system.say("\n".join([f"  {title}:", *(lines or [""])]))
