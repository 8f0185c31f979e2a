"""Where a word of ros2 was said: in a terminal, with its environment, or somewhere that waits for nobody."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from sim.notebook import in_notebook
from sim.ros.fibers.scheduler import active
from sim.ros2.system import Wrong

LIBRARIES = "LD_LIBRARY_PATH"


def environment_before() -> dict[str, str]:
    """The environment as it was before this package and its libraries changed it."""
    words_ = Path("/proc/self/environ").read_bytes().split(b"\0")
    before = dict(word.decode(errors="surrogateescape").split("=", 1) for word in words_ if b"=" in word)
    before.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
    folders = [one for one in before.pop(LIBRARIES, "").split(os.pathsep) if not one.startswith(sys.prefix)]
    return before | ({LIBRARIES: os.pathsep.join(folders)} if any(folders) else {})


def need_terminal(words: str, instead: str) -> None:
    """Raise Wrong where what these words start would not be a process beside others."""
    if active() is not None or in_notebook():
        raise Wrong(f"`ros2 {words}` starts processes of their own, in a terminal. Here, write {instead}.")
