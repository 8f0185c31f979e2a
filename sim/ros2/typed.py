"""The words of ros2 as a program of a run, as if somebody typed them in a terminal beside it."""

from __future__ import annotations

import shlex
from collections.abc import Callable

import rclpy
from rclpy.exceptions import NameValidationException

from sim.ros.engine.program import Process
from sim.ros2 import words
from sim.ros2.live import Live
from sim.ros2.system import OWN_NAME, T, Voice, Work, Wrong


def terminal(command: str | Callable[[], str]) -> Process:
    """A program for `run` that does what a command does, such as "ros2 topic hz /scan".

    command: all words, "ros2" among them; or a function that gives them, called when the program starts.
    What can't be read is printed, as in a terminal, and the program ends.
    """

    def ros2() -> None:
        _type(command() if callable(command) else command)

    return Process(ros2)


def _type(line: str) -> None:
    if not isinstance(line, str):
        print(f"{line!r} is not a command: expected a text such as 'ros2 topic list'.")
        return
    try:
        first, *said = shlex.split(line, comments=True) or [""]
    except ValueError as error:
        print(f"{line!r} can't be read: {error}.")
        return
    if first != "ros2":
        print(f"{first}: command not found")
        return
    words.obey(words.parser(), said, lambda: Inside(print), print, print)


class Inside(Live):
    """The nodes of the run that this program is a part of; a context manager."""

    def __enter__(self) -> Inside:
        rclpy.init()
        self._node = rclpy.create_node(OWN_NAME, start_parameter_services=False, enable_rosout=False)
        return self

    def act(self, work: Work[T], seconds: float | None = None) -> T:
        """As `System`."""
        try:
            return work(self._node, Voice(self.say))
        except (NameValidationException, ValueError) as error:  # a name that none can have
            raise Wrong(" ".join(str(error).split())) from None
