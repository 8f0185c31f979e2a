"""ros2 commands as programs of a run, as if they were typed in a terminal beside it."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Sequence

import rclpy
from rclpy.exceptions import NameValidationException

from sim.ros.engine.program import Process
from sim.ros.launching.files import NoLaunchFile, find_launch_file
from sim.ros.launching.launch_program import as_launch_program
from sim.ros.packages import ExecutableNotFound, PackageNotFound, executable
from sim.ros2.group import UsageError
from sim.ros2.live import LiveSystem
from sim.ros2.parser import FAILED, execute, make_parser
from sim.ros2.system import OWN_NAME, CliError, NodeTask, Output, T

NOT_FOUND = 127  # exit status, as bash's


def terminal(command: str | Callable[[], str]) -> Process:
    """A program for `run` that executes a command, such as "ros2 topic hz /scan".

    command: the whole command, "ros2" included, or a function that returns it when the program starts.
    An invalid command prints an error, as in a terminal, and the program ends. The program of `ros2 run` or
    `ros2 launch` takes its place.
    """

    def ros2() -> Process | int:  # the program's name
        return _execute_line(command() if callable(command) else command)

    return Process(ros2)


def ros2() -> None:
    """Execute the command whose arguments are in `sys.argv`: the main() of `ros2` in a launch file."""
    _execute(sys.argv[1:])


ros2.bundled = True  # type: ignore[attr-defined]  # not the student's


def execute_words(words: Sequence[str]) -> Process | int:
    """Execute a command; returns its exit status, or the program that `ros2 run` or `ros2 launch` starts."""
    name, *arguments = words
    if name != "ros2":
        print(f"{name}: command not found")
        return NOT_FOUND
    if arguments[:1] in (["run"], ["launch"]):
        try:
            return _started(arguments)
        except (UsageError, PackageNotFound, ExecutableNotFound, NoLaunchFile) as error:
            print(error)
            return FAILED
    return _execute(arguments)


def _execute_line(line: str) -> Process | int:
    if not isinstance(line, str):
        print(f"{line!r} is not a command: expected a text such as 'ros2 topic list'.")
        return FAILED
    try:
        words = shlex.split(line, comments=True) or [""]
    except ValueError as error:
        print(f"{line!r} can't be read: {error}.")
        return FAILED
    return execute_words(words)


def _started(arguments: Sequence[str]) -> Process:
    """The program of `ros2 run` or `ros2 launch`. Raises what `execute_words` prints."""
    options = make_parser(typed=arguments).parse_args(arguments)
    if options.command == "run":
        main = executable(options.package_name, options.executable_name)
        return Process(main, arguments=options.argv)
    given = [options.package_name, options.launch_file_name, *options.launch_arguments]
    path, rest = find_launch_file([each for each in given if each is not None])
    program: Process = as_launch_program(Process(path, arguments=rest))
    return program


def _execute(arguments: Sequence[str]) -> int:
    return execute(make_parser(), list(arguments), lambda _: RunSystem(print), print, print)


class RunSystem(LiveSystem):
    """The nodes of the run that this program is a part of; a context manager."""

    def __enter__(self) -> RunSystem:
        rclpy.init()
        self._node = rclpy.create_node(OWN_NAME, start_parameter_services=False, enable_rosout=False)
        return self

    def run_with_node(self, task: NodeTask[T], seconds: float | None = None) -> T:
        """Work like `System`."""
        try:
            return task(self._node, Output(self.print_line))
        except (NameValidationException, ValueError) as error:  # an invalid name
            raise CliError(" ".join(str(error).split())) from None
