"""%ros2 in a notebook: commands on the running player, or on the last run."""

from __future__ import annotations

import itertools
import shlex
from argparse import Namespace
from collections.abc import Callable
from contextlib import nullcontext
from functools import cache
from typing import Any

from argcomplete import CompletionFinder, SuppressCompleter

from sim.ros.latest import latest
from sim.ros2.group import Completer, Parser
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


def completions(line: str) -> list[str]:
    """Return what the last word of an incomplete command after %ros2 can be."""
    finder = CompletionFinder(
        make_parser(_make_completer),
        always_complete_options=False,
        exclude=["-h", "--help"],
        default_completer=SuppressCompleter(),
        append_space=False,
    )
    numbers = itertools.count()
    found = iter(lambda: finder.rl_complete(line, next(numbers)), None)
    before = len(line) - len(line.split(" ")[-1])
    return [whole[before:].rstrip() for whole in found]


def _make_completer(completer: Completer, without_system: bool) -> Callable[..., list[str]]:
    def complete(parsed_args: Namespace, **_: Any) -> list[str]:
        try:
            return completer(None if without_system else _system(), parsed_args)
        except CliError:
            return []

    return complete


@cache
def _parser() -> Parser:
    return make_parser()


def _system() -> System:
    if latest.player is not None:
        if not latest.player.nodes:
            latest.player.play_frame(0.0)  # the play has just begun: create its nodes
        return PlayedSystem(latest.player)
    if latest.recording is None:
        raise CliError("Nothing has run yet: start nodes with run(...) or play(...), and then inspect them.")
    return RecordedSystem(latest.recording)
