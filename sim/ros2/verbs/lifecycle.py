"""ros2 lifecycle: the states of nodes that have some, and their transitions."""

from __future__ import annotations

from argparse import Namespace

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState

from sim.ros2.group import Group, argument, flag
from sim.ros2.system import System, Wrong, ask, guess, is_hidden
from sim.suggestions import closest_match

lifecycle = Group("lifecycle", "Nodes with a lifecycle: their states and transitions")
HIDDEN = flag("--include-hidden-nodes", help="Consider hidden nodes as well")
STATE = "lifecycle_msgs/srv/GetState"


def managed(system: System, *, hidden: bool) -> list[str]:
    """The nodes that have a lifecycle, sorted."""
    services = system.names("service", hidden=True)
    return sorted(
        {
            node
            for node in system.nodes
            if STATE in services.get(f"{node}/get_state", []) and (hidden or not is_hidden(node))
        }
    )


def _managed(system: System, _: Namespace) -> list[str]:
    return managed(system, hidden=True)


def _node(system: System, asked: Namespace) -> str:
    full = asked.node_name if asked.node_name.startswith("/") else f"/{asked.node_name}"
    known = system.look_for(full, lambda: managed(system, hidden=asked.include_hidden_nodes))
    if full not in known:
        raise Wrong(f"Node not found{guess(full, known)}")
    return full


@lifecycle.verb(
    "nodes",
    flag("-a", "--all", help="Display all nodes even hidden ones"),
    flag("-c", "--count-nodes", help="Only display the number of nodes discovered"),
)
def nodes(system: System, asked: Namespace) -> None:
    """Output a list of nodes with lifecycle."""
    found = managed(system, hidden=asked.all)
    for line in [str(len(found))] if asked.count_nodes else found:
        system.say(line)


@lifecycle.verb(
    "get",
    argument("node_name", nargs="?", help="Name of the ROS node; all without", offers=_managed),
    HIDDEN,
)
def get(system: System, asked: Namespace) -> None:
    """Get lifecycle state for one or more nodes."""
    found = [_node(system, asked)] if asked.node_name else managed(system, hidden=asked.include_hidden_nodes)
    for node in found:
        service = f"{node}/get_state"
        state = system.act(
            lambda own, _, service=service: ask(own, GetState, service, GetState.Request())
        ).current_state
        prefix = "" if asked.node_name else f"{node}: "
        system.say(f"{prefix}{state.label} [{state.id}]")


@lifecycle.verb(
    "set",
    argument("node_name", help="Name of the ROS node", offers=_managed),
    argument("transition", help="The lifecycle transition"),
    HIDDEN,
)
def set_(system: System, asked: Namespace) -> None:
    """Trigger lifecycle state transition."""
    node = _node(system, asked)
    request = GetAvailableTransitions.Request()
    service = f"{node}/get_available_transitions"
    found = system.act(lambda own, _: ask(own, GetAvailableTransitions, service, request))
    chosen = _chosen([one.transition for one in found.available_transitions], asked.transition)
    change = ChangeState.Request(transition=chosen)
    if not system.act(lambda own, _: ask(own, ChangeState, f"{node}/change_state", change)).success:
        raise Wrong("Transitioning failed")
    system.say("Transitioning successful")


def _chosen(available: list[Transition], word: str) -> Transition:
    for one in available:
        if word in (one.label, str(one.id)):
            return one
    near = closest_match(word, [one.label for one in available])
    lines = "".join(f"\n- {one.label} [{one.id}]" for one in available)
    hint = f"\nDid you mean {near}?" if near else ""
    raise Wrong(f"Unknown transition requested, available ones are:{lines}{hint}")
