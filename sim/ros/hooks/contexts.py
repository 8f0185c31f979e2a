"""Refuses what a node does after rclpy.shutdown(), with rclpy's exceptions."""

from __future__ import annotations

from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node

from sim.ros.engine.running_program import shared_context
from sim.ros.fibers.scheduler import engine

INVALID = "rcl node's context is invalid"
NOT_VALID = "the given context is not valid, either rcl_init() was not called or rcl_shutdown() was called."


def require_context(node: Node, failed: str, reason: str = INVALID) -> None:
    """Raise RCLError in a run if the node's program has shut rclpy down. failed: what can't be done."""
    context = getattr(node, "_context", None)  # Node.__init__ may not have been called
    if engine() is not None and context is not None and not shared_context(context).alive:
        raise _rclpy.RCLError(f"{failed}: {reason}")
