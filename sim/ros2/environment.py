"""The environment in which a ros2 command runs: that of the terminal, or a notebook or run."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from sim.ros.fibers.scheduler import active
from sim.ros2.system import CliError

LIBRARY_PATH = "LD_LIBRARY_PATH"


def environment_before() -> dict[str, str]:
    """The environment of this process before this package and its libraries changed it."""
    variables = Path("/proc/self/environ").read_bytes().split(b"\0")
    before = dict(line.decode(errors="surrogateescape").split("=", 1) for line in variables if b"=" in line)
    before.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
    folders = before.pop(LIBRARY_PATH, "").split(os.pathsep)
    folders = [path for path in folders if not path.startswith(sys.prefix)]
    return before | ({LIBRARY_PATH: os.pathsep.join(folders)} if any(folders) else {})


def require_terminal(command: str, alternative: str) -> None:
    """Raise CliError in a notebook or a run, where a command can't start processes of its own."""
    from sim.notebook import in_notebook  # imported late, because it is slow, as the recording is

    if active() is not None or in_notebook():
        raise CliError(
            f"`ros2 {command}` starts processes of their own, in a terminal. Here, write {alternative}."
        )
