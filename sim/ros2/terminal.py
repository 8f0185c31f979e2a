# PYTHON_ARGCOMPLETE_OK
"""ros2 in a terminal. Where the official command is installed, that one is run instead."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import argcomplete
from rclpy.executors import ExternalShutdownException

from sim.ros2 import words
from sim.ros2.live import Live
from sim.ros2.system import System, Wrong

STOPPED = 2  # exit status after Ctrl-C, as the official command's
MARK = b"sim.ros2"  # what the script that starts this one holds, wherever it is installed
LIBRARIES = "LD_LIBRARY_PATH"


def main() -> int:
    """What `ros2` on the command line does; the exit status."""
    give_way()
    reader = words.parser(_offered)
    argcomplete.autocomplete(reader, exclude=["-h", "--help"])
    try:
        return words.obey(reader, None, lambda: Live(_say, _complain), _say, _complain)
    except (KeyboardInterrupt, ExternalShutdownException):
        return STOPPED
    except BrokenPipeError:  # as of `ros2 topic echo /scan | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _say(line: str) -> None:
    print(line, flush=True)


def _complain(line: str) -> None:
    if line:
        print(line, file=sys.stderr, flush=True)


def _offered(offers: Callable[[System], list[str]]) -> Callable[..., list[str]]:
    def complete(**_: Any) -> list[str]:
        try:
            with Live() as system:
                return offers(system)
        except Wrong:
            return []

    return complete


def give_way() -> None:
    """Become the official command, if there is one."""
    official = official_command(os.environ.get("PATH", ""))
    if official is not None:
        os.execve(official, [str(official), *sys.argv[1:]], _environment_before())


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


def _environment_before() -> dict[str, str]:
    """The environment as it was before this package and its libraries changed it."""
    words_ = Path("/proc/self/environ").read_bytes().split(b"\0")
    before = dict(word.decode(errors="surrogateescape").split("=", 1) for word in words_ if b"=" in word)
    before.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
    folders = [one for one in before.pop(LIBRARIES, "").split(os.pathsep) if not one.startswith(sys.prefix)]
    return before | ({LIBRARIES: os.pathsep.join(folders)} if any(folders) else {})


if __name__ == "__main__":
    sys.exit(main())
