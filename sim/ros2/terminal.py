# PYTHON_ARGCOMPLETE_OK
"""ros2 in a terminal. If the official command is installed, it is executed instead."""

from __future__ import annotations

import os
import signal
import sys
import time
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from typing import Any

import argcomplete
from rclpy.executors import ExternalShutdownException

from sim.ros2 import parser
from sim.ros2.environment import environment_before
from sim.ros2.group import Completer
from sim.ros2.live import LiveSystem
from sim.ros2.system import CliError
from sim.ros2.type_support import import_without_generators

COMPLETION_SETTLING_TIME = 0.1  # s
LONGEST_COMPLETION = 2.0  # s for which names are awaited that begin with what was typed
RETRY_INTERRUPT = 0.1  # s until a lost Ctrl-C is repeated
INTERRUPTED = 2  # exit status after Ctrl-C, as the official command's
KERNEL = "JPY_PARENT_PID"  # set in a notebook's kernel, and in what its cells start
IN_CELL = "!ros2 looks at other processes. For what run(...) and play(...) do in this notebook, write %ros2."
MARK = b"sim.ros2"  # in the installed script that starts this module


def main() -> int:
    """Execute `ros2` on the command line; returns the exit status."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it quietly while it has nothing to clean up
    exec_real_ros2()
    import_without_generators()
    command_parser = parser.make_parser(_make_completer, parser.typed_words())
    # Complete options only after a dash; if nothing is known, bash completes file names.
    argcomplete.autocomplete(
        command_parser,
        always_complete_options=False,
        exclude=["-h", "--help"],
        default_completer=argcomplete.SuppressCompleter(),
    )
    signal.signal(signal.SIGINT, _interrupted)
    try:
        return parser.execute(command_parser, None, _open_system, _print_line, _print_error)
    except (KeyboardInterrupt, ExternalShutdownException):
        return INTERRUPTED
    except BrokenPipeError:  # such as of `ros2 topic echo /scan | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def _open_system(options: Namespace) -> LiveSystem:
    if KERNEL in os.environ:  # a notebook's cell with !ros2
        _print_error(IN_CELL)
    return LiveSystem(_print_line, _print_error, spin_time=getattr(options, "spin_time", None))


def _interrupted(*_: Any) -> None:
    # If it interrupts rclpy in a constructor, the incomplete object's destructor would print an error.
    sys.unraisablehook = _repeat_interrupt
    raise KeyboardInterrupt


def _repeat_interrupt(unraisable: Any) -> None:
    # An interrupt in a destructor is lost, so it is repeated; later, because this is still in the destructor.
    if unraisable.exc_type is KeyboardInterrupt:
        signal.signal(signal.SIGALRM, _interrupted)
        signal.setitimer(signal.ITIMER_REAL, RETRY_INTERRUPT)


def _print_line(line: str) -> None:
    print(line, flush=True)


def _print_error(line: str) -> None:
    if line:
        print(line, file=sys.stderr, flush=True)


def _make_completer(completer: Completer, without_system: bool) -> Callable[..., list[str]]:
    def complete(prefix: str, parsed_args: Namespace, **_: Any) -> list[str]:
        try:
            if without_system:
                return completer(None, parsed_args)
            end = time.monotonic() + LONGEST_COMPLETION
            with LiveSystem(settling_time=COMPLETION_SETTLING_TIME) as system:
                while True:
                    found = completer(system, parsed_args)
                    if any(name.startswith(prefix) for name in found) or time.monotonic() > end:
                        return found
                    system.wait_for_graph()
        except CliError:
            return []

    return complete


def exec_real_ros2() -> None:
    """Replace this process with the official ros2 command, if it is installed."""
    official = official_command(os.environ.get("PATH", ""))
    if official is not None:
        os.execve(official, [str(official), *sys.argv[1:]], environment_before())


def official_command(path: str) -> Path | None:
    """The first `ros2` on a search path that is not the course's."""
    for folder in path.split(os.pathsep):
        command = Path(folder) / "ros2"
        try:
            if folder and os.access(command, os.X_OK) and MARK not in command.read_bytes():
                return command
        except OSError:
            continue
    return None


if __name__ == "__main__":
    sys.exit(main())
