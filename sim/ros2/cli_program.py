"""ros2 commands as programs of a run, as if they were typed in a terminal beside it."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Sequence

import rclpy
from rclpy.exceptions import NameValidationException

from sim.ros.engine.program import Process
from sim.ros2.live import LiveSystem
from sim.ros2.parser import execute, make_parser
from sim.ros2.system import OWN_NAME, CliError, NodeTask, Output, T


def terminal(command: str | Callable[[], str]) -> Process:
    """A program for `run` that executes a command, such as "ros2 topic hz /scan".

    command: the whole command, "ros2" included, or a function that returns it when the program starts.
    An invalid command prints an error, as in a terminal, and the program ends.
    """

    def ros2() -> None:  # the program's name
        _execute_line(command() if callable(command) else command)

    return Process(ros2)


def ros2() -> None:
    """Execute the command whose arguments are in `sys.argv`: the main() of `ros2` in a launch file."""
    _execute(sys.argv[1:])


ros2.bundled = True  # not the student's


def _execute_line(line: str) -> None:
    if not isinstance(line, str):
        print(f"{line!r} is not a command: expected a text such as 'ros2 topic list'.")
        return
    try:
        name, *arguments = shlex.split(line, comments=True) or [""]
    except ValueError as error:
        print(f"{line!r} can't be read: {error}.")
        return
    if name != "ros2":
        print(f"{name}: command not found")
        return
    _execute(arguments)


def _execute(arguments: Sequence[str]) -> None:
    execute(make_parser(), list(arguments), lambda _: RunSystem(print), print, print)


class RunSystem(LiveSystem):
    """The nodes of the run that this program is a part of; a context manager."""

    def __enter__(self) -> RunSystem:
        rclpy.init()
        self._node = rclpy.create_node(OWN_NAME, start_parameter_services=False, enable_rosout=False)
        return self

    def run_with_node(self, task: NodeTask[T], seconds: float | None = None) -> T:
        """As `System`."""
        try:
            return task(self._node, Output(self.print_line))
        except (NameValidationException, ValueError) as error:  # an invalid name
            raise CliError(" ".join(str(error).split())) from None
