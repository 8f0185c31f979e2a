"""Refuses what a node does after rclpy.shutdown(), with rclpy's exceptions."""

from __future__ import annotations

from rclpy.context import Context
from rclpy.node import Node

from sim.ros.engine.running_program import shared_context
from sim.ros.fibers.scheduler import engine
from sim.ros.rclpy_cpp import cpp

INVALID = "rcl node's context is invalid"


def is_shut_down(context: Context | None) -> bool:
    """Return whether a program of a run has shut down this context of its own."""
    return engine() is not None and context is not None and not shared_context(context).alive


def require_context(node: Node, failed: str, reason: str = INVALID) -> None:
    """Raise RCLError in a run if the node's program has shut rclpy down. failed: what can't be done."""
    if is_shut_down(getattr(node, "_context", None)):  # Node.__init__ may not have been called
        raise cpp.RCLError(f"{failed}: {reason}")
