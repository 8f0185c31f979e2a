"""%ros2 in a notebook: commands on the running player, or on the last run."""

from __future__ import annotations

import shlex
from contextlib import nullcontext
from functools import cache

from sim.ros.latest import latest
from sim.ros2.group import Parser
from sim.ros2.parser import execute, make_parser
from sim.ros2.recorded import PlayedSystem, RecordedSystem
from sim.ros2.system import CliError, System


def ros2(line: str) -> None:
    """Execute the command after %ros2. All output goes to stdout: nbgrader takes stderr for a failure."""
    try:
        arguments = shlex.split(line, comments=True)
    except ValueError as error:
        print(f"{line!r} can't be read: {error}.")
        return
    try:
        execute(_parser(), arguments, lambda _: nullcontext(_system()), print, print)
    except KeyboardInterrupt:
        print("Stopped.")


@cache
def _parser() -> Parser:
    return make_parser()


def _system() -> System:
    if latest.player is not None:
        if not latest.player.nodes:
            latest.player.play_frame(0.0)  # the play has just begun: create its nodes
        return PlayedSystem(latest.player)
    if latest.recording is None:
        raise CliError(
            "Nothing has run yet: start nodes with run(...) or play(...), and then ask about them."
        )
    return RecordedSystem(latest.recording)
