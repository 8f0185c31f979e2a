"""Starts a student's program with a value of a parameter that it has to refuse."""

import functools
from dataclasses import replace
from typing import Any

import rclpy
from rclpy.exceptions import InvalidParameterValueException

from sim import Process

REFUSED = "not_started"  # the node that is there in place of a program that refused its value


def started_with(program: Any, name: str, value: Any) -> Process:
    """Return the program, started with this value. Where it refuses it, an idle node takes its place."""
    process = program if isinstance(program, Process) else Process(program)
    target: Any = process.target

    @functools.wraps(target, updated=())
    def start(**arguments: Any) -> Any:
        try:
            return target(**arguments)
        except InvalidParameterValueException:
            if not rclpy.ok():  # a main() that cleans up
                rclpy.init()
            return rclpy.create_node(REFUSED)

    return replace(process, target=start, parameters={name: value})
