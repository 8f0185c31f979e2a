"""The programs of one robot for several: each has them in its namespace, as a launch file would do."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from sim.ros.engine.program import Process, as_process


def team(program: Any, *robots: str) -> list[Process]:
    """A program once for each of these robots; "robot" is the first one, which has no namespace."""
    return [replace(as_process(program), namespace=None if robot == "robot" else robot) for robot in robots]
