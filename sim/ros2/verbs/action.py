"""ros2 action: which actions there are, and a goal for one."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node

from sim.evidence import STATUSES
from sim.ros2.group import Group, argument, flag
from sim.ros2.system import POLL, System, Voice, Wrong, answer, guess
from sim.ros2.text import as_yaml, fill, read_values
from sim.ros2.types import type_of

action = Group("action", "Actions: list them, send a goal")
TYPES = flag("-t", "--show-types", help="Additionally show the action type")
NAME = argument(
    "action_name",
    help="Name of the ROS action (e.g. '/fibonacci')",
    offers=lambda system, _: list(actions(system)),
)


def actions(system: System) -> dict[str, list[str]]:
    """Name to types of all actions."""
    return system.names("action server", "action client")


@action.verb("list", TYPES, flag("-c", "--count-actions", help="Only display the number of actions"))
def list_(system: System, asked: Namespace) -> None:
    """Output a list of action names."""
    found = actions(system)
    if asked.count_actions:
        system.say(str(len(found)))
        return
    for name, types in found.items():
        system.say(f"{name} [{', '.join(types)}]" if asked.show_types else name)


@action.verb("info", NAME, TYPES, flag("-c", "--count", help="Only display the numbers"))
def info(system: System, asked: Namespace) -> None:
    """Print information about an action."""
    name = asked.action_name if asked.action_name.startswith("/") else f"/{asked.action_name}"
    known = actions(system)
    near = "" if name in known else guess(name, known).removeprefix(".")
    system.say(f"Action: {asked.action_name}{near}")
    for kind in ("client", "server"):
        ends = [end for end in system.ends if (end.kind, end.name) == (f"action {kind}", name)]
        system.say(f"Action {kind}s: {len(ends)}")
        for end in ends if not asked.count else ():
            system.say(f"    {end.node} [{end.type}]" if asked.show_types else f"    {end.node}")


@action.verb("type", NAME)
def type_(system: System, asked: Namespace) -> None:
    """Print an action's type."""
    known = actions(system)
    if asked.action_name not in known:
        raise Wrong(f"Unknown action '{asked.action_name}'{guess(asked.action_name, known)}")
    for name in known[asked.action_name]:
        system.say(name)


@action.verb(
    "send_goal",
    NAME,
    argument(
        "action_type",
        help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')",
        offers=lambda system, asked: actions(system).get(asked.action_name, []),
    ),
    argument("goal", nargs="?", default="{}", help="Goal request values in YAML (e.g. '{order: 10}')"),
    flag("-f", "--feedback", help="Echo feedback messages for the goal"),
)
def send_goal(system: System, asked: Namespace) -> None:
    """Send an action goal."""
    kind = type_of(asked.action_type, "action", "The passed action type is invalid")
    goal = kind.Goal()
    fill(goal, read_values(asked.goal), "Failed to populate message fields: {!r}")
    near = "" if asked.action_name in (known := actions(system)) else guess(asked.action_name, known)
    system.act(lambda node, voice: _send(node, voice, kind, goal, asked, near.removeprefix(".")))


def _send(node: Node, voice: Voice, kind: type, goal: Any, asked: Namespace, near: str) -> None:
    client = ActionClient(node, kind, asked.action_name)

    def on_feedback(feedback: Any) -> None:
        voice.say(f"Feedback:\n    {as_yaml(feedback.feedback)}")

    try:
        voice.say(f"Waiting for an action server to become available...{near}")
        while not client.server_is_ready() and not voice.stopped:
            rclpy.spin_once(node, timeout_sec=POLL)
        voice.say(f"Sending goal:\n     {as_yaml(goal)}")
        handle = answer(node, client.send_goal_async(goal, on_feedback if asked.feedback else None))
        if not handle.accepted:
            voice.say("Goal was rejected.")
            return
        voice.say(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
        _await_result(node, voice, handle)
    finally:
        client.destroy()


def _await_result(node: Node, voice: Voice, handle: Any) -> None:
    """Show the result; Ctrl-C cancels the goal."""
    try:
        result = answer(node, handle.get_result_async())
    except KeyboardInterrupt:
        voice.say("Canceling goal...")
        canceled = answer(node, handle.cancel_goal_async()).goals_canceling
        voice.say("Goal canceled." if canceled else "Failed to cancel goal")
        raise
    voice.say(f"Result:\n    {as_yaml(result.result)}")
    status = STATUSES[result.status - 1].upper() if 0 < result.status <= len(STATUSES) else "UNKNOWN"
    voice.say(f"Goal finished with status: {status}")
