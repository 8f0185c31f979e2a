"""Runs the programs of one robot for several robots, each in its namespace, like a launch file."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from sim.ros.engine.program import Process, as_process


def in_namespaces(program: Any, *robots: str) -> list[Process]:
    """One copy of a program per robot; the first, "robot", has no namespace."""
    return [replace(as_process(program), namespace=None if robot == "robot" else robot) for robot in robots]
