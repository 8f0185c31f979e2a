"""ros2 lifecycle: states and transitions of lifecycle nodes."""

from __future__ import annotations

from argparse import Namespace

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState

from sim.ros2.group import Group, argument, flag
from sim.ros2.system import CliError, System, is_hidden, suggestion
from sim.suggestions import closest_match

lifecycle = Group("lifecycle", "Nodes with a lifecycle: their states and transitions")
HIDDEN = flag("--include-hidden-nodes", help="Consider hidden nodes as well")
STATE = "lifecycle_msgs/srv/GetState"


def managed(system: System, *, hidden: bool) -> list[str]:
    """The lifecycle nodes, sorted."""
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


def _node(system: System, options: Namespace) -> str:
    full = options.node_name if options.node_name.startswith("/") else f"/{options.node_name}"
    known = system.look_up(full, lambda: managed(system, hidden=options.include_hidden_nodes))
    if full not in known:
        raise CliError(f"Node not found{suggestion(full, known)}")
    return full


@lifecycle.verb(
    "nodes",
    flag("-a", "--all", help="Display all nodes even hidden ones"),
    flag("-c", "--count-nodes", help="Only display the number of nodes discovered"),
)
def nodes(system: System, options: Namespace) -> None:
    """Output a list of nodes with lifecycle."""
    found = managed(system, hidden=options.all)
    for line in [str(len(found))] if options.count_nodes else found:
        system.print_line(line)


@lifecycle.verb(
    "get",
    argument("node_name", nargs="?", help="Name of the ROS node; all without", completer=_managed),
    HIDDEN,
)
def get(system: System, options: Namespace) -> None:
    """Get lifecycle state for one or more nodes."""
    found = (
        [_node(system, options)]
        if options.node_name
        else managed(system, hidden=options.include_hidden_nodes)
    )
    for node in found:
        state = system.call(GetState, f"{node}/get_state", GetState.Request()).current_state
        prefix = "" if options.node_name else f"{node}: "
        system.print_line(f"{prefix}{state.label} [{state.id}]")


@lifecycle.verb(
    "set",
    argument("node_name", help="Name of the ROS node", completer=_managed),
    argument("transition", help="The lifecycle transition"),
    HIDDEN,
)
def set_(system: System, options: Namespace) -> None:
    """Trigger lifecycle state transition."""
    node = _node(system, options)
    request = GetAvailableTransitions.Request()
    response = system.call(GetAvailableTransitions, f"{node}/get_available_transitions", request)
    available = [each.transition for each in response.available_transitions]
    change = ChangeState.Request(transition=_find(available, options.transition))
    if not system.call(ChangeState, f"{node}/change_state", change).success:
        raise CliError("Transitioning failed")
    system.print_line("Transitioning successful")


@lifecycle.verb(
    "list",
    argument("node_name", help="Name of the ROS node", completer=_managed),
    HIDDEN,
    flag("-a", "--all", help="Display all existing transitions"),
)
def list_(system: System, options: Namespace) -> None:
    """Output a list of available transitions."""
    node = _node(system, options)
    service = "get_transition_graph" if options.all else "get_available_transitions"
    request = GetAvailableTransitions.Request()
    for each in system.call(GetAvailableTransitions, f"{node}/{service}", request).available_transitions:
        system.print_line(f"- {each.transition.label} [{each.transition.id}]")
        system.print_line(f"\tStart: {each.start_state.label}")
        system.print_line(f"\tGoal: {each.goal_state.label}")


def _find(available: list[Transition], label_or_id: str) -> Transition:
    for each in available:
        if label_or_id in (each.label, str(each.id)):
            return each
    near = closest_match(label_or_id, [each.label for each in available])
    lines = "".join(f"\n- {each.label} [{each.id}]" for each in available)
    hint = f"\nDid you mean {near}?" if near else ""
    raise CliError(f"Unknown transition requested, available ones are:{lines}{hint}")
