"""%ros2 in a notebook: about the play that is going on, or the last run."""

from __future__ import annotations

import shlex
from contextlib import nullcontext
from functools import cache

from sim.ros.latest import latest
from sim.ros2 import words
from sim.ros2.group import Parser
from sim.ros2.recorded import Played, Recorded
from sim.ros2.system import System, Wrong


def ros2(line: str) -> None:
    """Do what the words after %ros2 say. All is shown on stdout: nbgrader takes stderr for a failure."""
    try:
        said = shlex.split(line, comments=True)
    except ValueError as error:
        print(f"{line!r} can't be read: {error}.")
        return
    try:
        words.obey(_reader(), said, lambda: nullcontext(_system()), print, print)
    except KeyboardInterrupt:
        print("Stopped.")


@cache
def _reader() -> Parser:
    return words.parser()


def _system() -> System:
    if latest.player is not None:
        if not latest.player.nodes:
            latest.player.play_frame(0.0)  # it has just begun: its nodes are made now
        return Played(latest.player)
    if latest.recording is None:
        raise Wrong("Nothing has run yet: start nodes with run(...) or play(...), and then ask about them.")
    return Recorded(latest.recording)
