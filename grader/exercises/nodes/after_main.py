"""A run of a student's main() with a look at what it leaves behind."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any

import rclpy
from rclpy.logging import get_logger
from rclpy.node import Node

from grader.exercise import Scenario
from sim.recording import Recording, Seconds

LOGGER, OBSERVER = "after_main", "observer"


class AfterMain(Scenario):
    """One run in which every main() is followed by a log line on how it ended; `trace_of` reads it."""

    def run(self, nodes: Sequence[Any], seed: int) -> Recording:
        """As Scenario.run."""
        return super().run([_observed(node) for node in nodes], seed)


class Trace:
    """What a main() left behind.

    interrupted: KeyboardInterrupt came out of it. still_up: rclpy.shutdown() is missing.
    nodes: those not destroyed, by their full names, separated by commas. stamp: when main() was over.
    """

    def __init__(self, stamp: Seconds, text: str) -> None:
        words = dict(part.split("=") for part in text.split(" "))
        self.stamp = stamp
        self.interrupted, self.still_up = words["interrupted"] == "True", words["still_up"] == "True"
        self.nodes = words["nodes"]


def trace_of(recording: Recording) -> Trace | None:
    """What main() left behind; None when it never came to its end."""
    lines = [line for line in recording.logs if line.node == LOGGER]
    return Trace(lines[0].stamp, lines[0].text) if lines else None


def _observed(main: Any) -> Any:
    """The same main(), which then looks around before its program is over. Anything else stays as it is."""
    if isinstance(main, type) or not hasattr(main, "__name__"):
        return main

    @functools.wraps(main)
    def main_and_look(**arguments: Any) -> Any:
        interrupted, result = False, None
        try:
            result = main(**arguments)
        except KeyboardInterrupt:
            interrupted = True
        if not isinstance(result, Node):
            _look(interrupted)
        return result

    return main_and_look


def _look(interrupted: bool) -> None:
    still_up = rclpy.ok()
    if not still_up:
        rclpy.init()
    observer = Node(OBSERVER)
    found = observer.get_node_names_and_namespaces()
    left = ",".join(sorted(f"{space.rstrip('/')}/{name}" for name, space in found if name != OBSERVER))
    get_logger(LOGGER).info(f"interrupted={interrupted} still_up={still_up} nodes={left}")
    observer.destroy_node()
    rclpy.shutdown()
