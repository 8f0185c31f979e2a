"""A right node that works never, or only at the beginning or at the end of its run."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable, Iterable
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future

from sim import Process
from tests.students.teams import Team

# name: the parts of a run's time from which and until which the node is spun
TIMES = {"never": (1.0, 0.0), "at first": (0.0, 0.25), "at last": (0.75, 1.0)}


def spun_until(target: Any, end: float) -> Any:
    """The program with a node that is spun for so many seconds, and then the program ends.

    None where it is no class of a node, whose spinning one could end.
    """
    if isinstance(target, Team):
        return _team(spun_until(program, end) for program in target.programs)
    if isinstance(target, Process):
        inner = spun_until(target.target, end)
        return inner and dataclasses.replace(target, target=inner)
    if not (isinstance(target, type) and issubclass(target, Node)):
        return None

    def main(args: list[str] | None = None) -> None:
        rclpy.init(args=args)
        node, executor = target(), SingleThreadedExecutor()
        executor.add_node(node)
        executor.spin_until_future_complete(Future(), timeout_sec=end)
        node.destroy_node()
        rclpy.shutdown()

    return main


def working(target: Any, times: str, seconds: float) -> Any:
    """The program with a node that is there all the time, and works only at these times of `TIMES`.

    None where it is no class of a node, whose spinning one could hold up.
    """
    if isinstance(target, Team):
        return _team(working(program, times, seconds) for program in target.programs)
    if isinstance(target, Process):
        inner = working(target.target, times, seconds)
        return inner and dataclasses.replace(target, target=inner)
    if not (isinstance(target, type) and issubclass(target, Node)):
        return None
    begin, end = (part * seconds for part in TIMES[times])
    return _program(target, begin, end)


def _team(programs: Iterable[Any]) -> Team | None:
    found = tuple(programs)
    return Team(*found) if all(found) else None


def _program(make: Callable[[], Node], begin: float, end: float) -> Callable[..., None]:
    def main(args: list[str] | None = None) -> None:
        rclpy.init(args=args)
        node = make()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        started = time.monotonic()
        while rclpy.ok():
            if begin <= time.monotonic() - started < end:
                executor.spin_once(timeout_sec=0.05)
            else:
                time.sleep(0.05 if end > begin else math.inf)

    return main
