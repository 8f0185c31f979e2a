"""Nodes of one name in one program: what the end of one of them does to the other."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node

from sim.evidence import NAMELESS
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook


@hook(Node, "destroy_node", "a namesake's log lines are on /rosout no longer, and ROS does not say so")
def destroy_node(original: Callable) -> Callable:
    def destroy_node(self: Node) -> None:
        run = engine()
        if run is not None:
            nodes = run.current.process.nodes
            namesakes = [node for node in nodes if node is not self and _name(node) == _name(self) != ""]
            if namesakes:
                run.recorder.node_fact(self, NAMELESS)
        original(self)

    return destroy_node


def _name(node: Node) -> str:
    """A node's full name; "" if it was destroyed."""
    try:
        return node.get_fully_qualified_name()
    except InvalidHandle:
        return ""
