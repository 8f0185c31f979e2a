"""Observes what a student's main() leaves behind when it returns."""

import functools
from typing import Any, NamedTuple

import rclpy
from rclpy.node import Node

from sim.evidence import Recording

OBSERVER = "observer"


class Trace(NamedTuple):
    """Traces that a main() left behind."""

    raised: str  # the name of the exception that came out of it, "" if none did
    still_up: bool  # rclpy.ok() is still True
    nodes: str  # full names of those not destroyed, separated by commas


def trace_of(recording: Recording) -> Trace | None:
    """Return what main() left behind; None if it never returned."""
    for line in recording.logs:
        if line.node == OBSERVER:
            words = dict(part.split("=") for part in line.text.split(" "))
            return Trace(words["raised"], words["still_up"] == "True", words["nodes"])
    return None


def observed(main: Any) -> Any:
    """Return a main() that afterwards logs how it ended, for `trace_of`. Other programs stay as they are."""
    if isinstance(main, type) or not callable(main):
        return main

    @functools.wraps(main)
    def main_and_report(**arguments: Any) -> Any:
        try:
            result = main(**arguments)
        except (Exception, KeyboardInterrupt) as error:
            _report(type(error).__name__)
            raise
        if not isinstance(result, Node):
            _report("")
        return result

    return main_and_report


def _report(raised: str) -> None:
    still_up = rclpy.ok()
    if not still_up:
        rclpy.init()
    observer = Node(OBSERVER)
    found = observer.get_node_names_and_namespaces()
    left = ",".join(sorted(f"{space.rstrip('/')}/{name}" for name, space in found if name != OBSERVER))
    observer.get_logger().info(f"raised={raised} still_up={still_up} nodes={left}")
    observer.destroy_node()
    rclpy.shutdown()
