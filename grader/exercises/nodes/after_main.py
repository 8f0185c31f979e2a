"""A run of a student's main() with a look at what it leaves behind."""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

import rclpy
from rclpy.node import Node

from sim.evidence import Recording

OBSERVER = "observer"


class Trace(NamedTuple):
    """What a main() left behind."""

    raised: str  # the name of the exception that came out of it, "" if none did
    still_up: bool  # rclpy.ok() is still True
    nodes: str  # full names of those not destroyed, separated by commas


def trace_of(recording: Recording) -> Trace | None:
    """What main() left behind; None when it never came to its end."""
    for line in recording.logs:
        if line.node == OBSERVER:
            words = dict(part.split("=") for part in line.text.split(" "))
            return Trace(words["raised"], words["still_up"] == "True", words["nodes"])
    return None


def observed(main: Any) -> Any:
    """The same main(), which then logs how it ended; `trace_of` reads it. Anything else stays as it is."""
    if isinstance(main, type) or not callable(main):
        return main

    @functools.wraps(main)
    def main_and_look(**arguments: Any) -> Any:
        try:
            result = main(**arguments)
        except (Exception, KeyboardInterrupt) as error:
            _look(type(error).__name__)
            raise
        if not isinstance(result, Node):
            _look("")
        return result

    return main_and_look


def _look(raised: str) -> None:
    still_up = rclpy.ok()
    if not still_up:
        rclpy.init()
    observer = Node(OBSERVER)
    found = observer.get_node_names_and_namespaces()
    left = ",".join(sorted(f"{space.rstrip('/')}/{name}" for name, space in found if name != OBSERVER))
    observer.get_logger().info(f"raised={raised} still_up={still_up} nodes={left}")
    observer.destroy_node()
    rclpy.shutdown()
