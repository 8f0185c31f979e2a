"""A run of a student's main() with a look at what it leaves behind."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any, NamedTuple

import rclpy
from rclpy.logging import get_logger
from rclpy.node import Node

from grader.exercise import Scenario
from sim.recording import Recording
from sim.ros.remote import PREPARATIONS, Remote

LOGGER, OBSERVER = "after_main", "observer"


class AfterMain(Scenario):
    """One run in which every main() is followed by a log line on how it ended; `trace_of` reads it."""

    def run(self, nodes: Sequence[Any], seed: int) -> Recording:
        """As Scenario.run."""
        for node in nodes:
            if isinstance(node, Remote):  # there, where main() runs, it is looked around
                node.preparation = LOGGER
        return super().run([_observed(node) for node in nodes], seed)


class Trace(NamedTuple):
    """What a main() left behind."""

    raised: str  # the name of the exception that came out of it, "" if none did
    still_up: bool  # rclpy.ok() is still True
    nodes: str  # full names of those not destroyed, separated by commas


def trace_of(recording: Recording) -> Trace | None:
    """What main() left behind; None when it never came to its end."""
    for line in recording.logs:
        if line.node == LOGGER:
            words = dict(part.split("=") for part in line.text.split(" "))
            return Trace(words["raised"], words["still_up"] == "True", words["nodes"])
    return None


def _observed(main: Any) -> Any:
    """The same main(), which then looks around before its program is over. Anything else stays as it is."""
    if isinstance(main, type | Remote) or not callable(main):
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


PREPARATIONS[LOGGER] = _observed


def _look(raised: str) -> None:
    still_up = rclpy.ok()
    if not still_up:
        rclpy.init()
    observer = Node(OBSERVER)
    found = observer.get_node_names_and_namespaces()
    left = ",".join(sorted(f"{space.rstrip('/')}/{name}" for name, space in found if name != OBSERVER))
    get_logger(LOGGER).info(f"raised={raised} still_up={still_up} nodes={left}")
    observer.destroy_node()
    rclpy.shutdown()
