"""ros2 action: list actions, and send a goal."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node

from sim.evidence import STATUSES
from sim.ros2.group import Group, argument, flag
from sim.ros2.interface_types import type_class
from sim.ros2.system import POLL, CliError, Output, System, suggestion, wait_for
from sim.ros2.text import as_yaml, fill, read_values

action = Group("action", "Actions: list them, send a goal")
TYPES = flag("-t", "--show-types", help="Additionally show the action type")
NAME = argument(
    "action_name",
    help="Name of the ROS action (e.g. '/fibonacci')",
    completer=lambda system, _: list(actions(system)),
)


def actions(system: System) -> dict[str, list[str]]:
    """Name to types of all actions."""
    return system.names("action server", "action client")


@action.verb("list", TYPES, flag("-c", "--count-actions", help="Only display the number of actions"))
def list_(system: System, options: Namespace) -> None:
    """Output a list of action names."""
    found = actions(system)
    if options.count_actions:
        system.print_line(str(len(found)))
        return
    for name, types in found.items():
        system.print_line(f"{name} [{', '.join(types)}]" if options.show_types else name)


@action.verb("info", NAME, TYPES, flag("-c", "--count", help="Only display the numbers"))
def info(system: System, options: Namespace) -> None:
    """Print information about an action."""
    name = options.action_name if options.action_name.startswith("/") else f"/{options.action_name}"
    known = actions(system)
    near = "" if name in known else suggestion(name, known).removeprefix(".")
    system.print_line(f"Action: {options.action_name}{near}")
    for kind in ("client", "server"):
        endpoints = [end for end in system.endpoints if (end.kind, end.name) == (f"action {kind}", name)]
        system.print_line(f"Action {kind}s: {len(endpoints)}")
        for end in endpoints if not options.count else ():
            system.print_line(f"    {end.node} [{end.type}]" if options.show_types else f"    {end.node}")


@action.verb("type", NAME)
def type_(system: System, options: Namespace) -> None:
    """Print an action's type."""
    known = actions(system)
    if options.action_name not in known:
        raise CliError(f"Unknown action '{options.action_name}'{suggestion(options.action_name, known)}")
    for name in known[options.action_name]:
        system.print_line(name)


@action.verb(
    "send_goal",
    NAME,
    argument(
        "action_type",
        help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')",
        completer=lambda system, options: actions(system).get(options.action_name, []),
    ),
    argument("goal", nargs="?", default="{}", help="Goal request values in YAML (e.g. '{order: 10}')"),
    flag("-f", "--feedback", help="Echo feedback messages for the goal"),
)
def send_goal(system: System, options: Namespace) -> None:
    """Send an action goal."""
    kind = type_class(options.action_type, "action", "The passed action type is invalid")
    goal = kind.Goal()
    fill(goal, read_values(options.goal), "Failed to populate message fields: {!r}")
    near = "" if options.action_name in (known := actions(system)) else suggestion(options.action_name, known)
    system.run_with_node(
        lambda node, output: _send(node, output, kind, goal, options, near.removeprefix("."))
    )


def _send(node: Node, output: Output, kind: type, goal: Any, options: Namespace, near: str) -> None:
    client = ActionClient(node, kind, options.action_name)

    def on_feedback(feedback: Any) -> None:
        output.print_line(f"Feedback:\n    {as_yaml(feedback.feedback)}")

    try:
        output.print_line(f"Waiting for an action server to become available...{near}")
        while not client.server_is_ready() and not output.canceled:
            rclpy.spin_once(node, timeout_sec=POLL)
        output.print_line(f"Sending goal:\n     {as_yaml(goal)}")
        handle = wait_for(node, client.send_goal_async(goal, on_feedback if options.feedback else None))
        if not handle.accepted:
            output.print_line("Goal was rejected.")
            return
        output.print_line(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
        _await_result(node, output, handle)
    finally:
        client.destroy()


def _await_result(node: Node, output: Output, handle: Any) -> None:
    """Print the result; Ctrl-C cancels the goal."""
    try:
        result = wait_for(node, handle.get_result_async())
    except KeyboardInterrupt:
        output.print_line("Canceling goal...")
        canceled = wait_for(node, handle.cancel_goal_async()).goals_canceling
        output.print_line("Goal canceled." if canceled else "Failed to cancel goal")
        raise
    output.print_line(f"Result:\n    {as_yaml(result.result)}")
    status = STATUSES[result.status - 1].upper() if 0 < result.status <= len(STATUSES) else "UNKNOWN"
    output.print_line(f"Goal finished with status: {status}")
