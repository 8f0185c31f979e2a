"""ros2 node: nodes and their connections."""

from __future__ import annotations

from argparse import Namespace

from sim.ros2.group import Group, argument, flag
from sim.ros2.system import CliError, System, is_hidden, suggestion

node = Group("node", "Nodes: list them, show how each is connected")
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
def list_(system: System, options: Namespace) -> None:
    """Output a list of available nodes."""
    names = sorted(name for name in system.nodes if options.all or not is_hidden(name))
    if options.count_nodes:
        system.print_line(str(len(names)))
        return
    if len(set(names)) < len(names):
        system.print_line(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, which can have"
            " unintended side effects."
        )
    for name in names:
        system.print_line(name)


@node.verb(
    "info",
    argument("node_name", help="Node name to request information", completer=lambda system, _: system.nodes),
    flag("--include-hidden", help="Display hidden topics, services, and actions as well"),
)
def info(system: System, options: Namespace) -> None:
    """Output information about a node."""
    known = [name for name in system.nodes if options.include_hidden or not is_hidden(name)]
    name = options.node_name
    count = known.count(name)
    if not count:
        raise CliError(f"Unable to find node '{name}'{suggestion(name, known)}")
    if count > 1:
        system.print_line(
            f'There are {count} nodes in the graph with the exact name "{name}". You are seeing information'
            " about only one of them."
        )
    system.print_line(name)
    endpoints = [end for end in system.endpoints if end.node == name]
    for title, kind in SECTIONS.items():
        shown = {end.name: end.type for end in endpoints if end.kind == kind}
        lines = [
            f"    {end}: {type_}"
            for end, type_ in sorted(shown.items())
            if options.include_hidden or not is_hidden(end)
        ]
        system.print_line("\n".join([f"  {title}:", *(lines or [""])]))
