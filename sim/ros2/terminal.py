# PYTHON_ARGCOMPLETE_OK
"""ros2 in a terminal. Where the official command is installed, that one is run instead."""

from __future__ import annotations

import os
import signal
import sys
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from typing import Any

import argcomplete
from rclpy.executors import ExternalShutdownException

from sim.ros2 import words
from sim.ros2.group import Offers
from sim.ros2.live import Live
from sim.ros2.surroundings import environment_before
from sim.ros2.system import Wrong

SOON = 0.1  # s without news, until names are completed: who waits for them can ask again
ONCE_MORE = 0.1  # s, until Ctrl-C that got lost is pressed again
STOPPED = 2  # exit status after Ctrl-C, as the official command's
MARK = b"sim.ros2"  # what the script that starts this one holds, wherever it is installed


def main() -> int:
    """What `ros2` on the command line does; the exit status."""
    give_way()
    signal.signal(signal.SIGINT, _interrupted)
    reader = words.parser(_offered)
    # Names come without options among them; where nothing is known, bash offers files.
    argcomplete.autocomplete(
        reader,
        always_complete_options=False,
        exclude=["-h", "--help"],
        default_completer=argcomplete.SuppressCompleter(),
    )
    try:
        return words.obey(reader, None, lambda: Live(_say, _complain), _say, _complain)
    except (KeyboardInterrupt, ExternalShutdownException):
        return STOPPED
    except BrokenPipeError:  # as of `ros2 topic echo /scan | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _interrupted(*_: Any) -> None:
    # It may hit rclpy while an object is made, and what is half made complains on stderr when it goes.
    sys.unraisablehook = _again
    raise KeyboardInterrupt


def _again(unheard: Any) -> None:
    # Where it hits rclpy while an object goes, nobody hears of it. Not at once: here it would be the same.
    if unheard.exc_type is KeyboardInterrupt:
        signal.signal(signal.SIGALRM, _interrupted)
        signal.setitimer(signal.ITIMER_REAL, ONCE_MORE)


def _say(line: str) -> None:
    print(line, flush=True)


def _complain(line: str) -> None:
    if line:
        print(line, file=sys.stderr, flush=True)


def _offered(offers: Offers, alone: bool) -> Callable[..., list[str]]:
    def complete(parsed_args: Namespace, **_: Any) -> list[str]:
        try:
            if alone:
                return offers(None, parsed_args)
            with Live(settled=SOON) as system:
                return offers(system, parsed_args)
        except Wrong:
            return []

    return complete


def give_way() -> None:
    """Become the official command, if there is one."""
    official = official_command(os.environ.get("PATH", ""))
    if official is not None:
        os.execve(official, [str(official), *sys.argv[1:]], environment_before())


def official_command(path: str) -> Path | None:
    """The first `ros2` in the folders of a search path that isn't ours."""
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
