"""A node that is created in a notebook's cell, outside a run: the error says to hand over the class."""

from __future__ import annotations

import sys
from collections.abc import Callable

from rclpy.exceptions import NotInitializedException
from rclpy.node import Node

from sim.notebook import in_notebook
from sim.ros.fibers.scheduler import engine
from sim.ros.hooks.table import hook


@hook(
    NotInitializedException,
    "__init__",
    "in a notebook the usual cause is run(Talker()) in place of run(Talker)",
)
def not_initialized(original: Callable) -> Callable:
    def __init__(self: NotInitializedException, message: str | None = None) -> None:
        original(self, message)
        name = _node_class() if engine() is None and in_notebook() else ""
        if name:
            said = (
                f"NotInitializedException: {name}() creates the node here, outside a run. Pass the class, "
                f"without parentheses: run({name}), not run({name}()); the run creates the node."
            )
            self._render_traceback_ = lambda: [said]  # type: ignore[attr-defined]

    return __init__


def _node_class() -> str:
    """The class of the node whose constructor raises; "" if it is none, or Node itself."""
    frame = sys._getframe(1)
    while frame is not None:
        node = frame.f_locals.get("self") if frame.f_code.co_name == "__init__" else None
        if isinstance(node, Node):
            name = type(node).__name__
            return "" if type(node) is Node else name
        frame = frame.f_back
    return ""
