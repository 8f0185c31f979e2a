"""All the words of ros2, and what happens when somebody says some."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from sim.ros2.group import WRONG_WORDS, Parser, WrongWords, parser_of
from sim.ros2.system import System, Voice, Wrong
from sim.ros2.verbs import listening, pkg_create, publishing  # noqa: F401  (each adds verbs to a group)
from sim.ros2.verbs.action import action
from sim.ros2.verbs.bag import bag
from sim.ros2.verbs.doctor import doctor
from sim.ros2.verbs.interface import interface
from sim.ros2.verbs.launch import launch
from sim.ros2.verbs.lifecycle import lifecycle
from sim.ros2.verbs.node import node
from sim.ros2.verbs.param import param
from sim.ros2.verbs.pkg import pkg
from sim.ros2.verbs.run import run
from sim.ros2.verbs.service import service
from sim.ros2.verbs.topic import topic

GROUPS = [action, bag, doctor, interface, launch, lifecycle, node, param, pkg, run, service, topic]
FAILED = 1  # exit status


def parser(offered: Callable[..., Any] = lambda *_: None) -> Parser:
    """The parser of all words; see `parser_of`."""
    return parser_of(GROUPS, offered)


def obey(
    reader: Parser,
    words: list[str] | None,
    system: Callable[[], AbstractContextManager[System]],
    say: Callable[[str], None],
    complain: Callable[[str], None],
) -> int:
    """Do what the words say; the exit status.

    words: those after "ros2"; None: of the command line. system: opens what they are about. say: shows a line
    of the answer. complain: shows what is wrong.
    """
    try:
        asked = reader.parse_args(words)
        if "work" not in asked:
            reader.print_help()
        elif asked.alone:
            asked.work(Voice(say), asked)
        else:
            with system() as opened:
                asked.work(opened, asked)
    except WrongWords as wrong:
        complain(str(wrong))
        return WRONG_WORDS
    except Wrong as wrong:
        complain(str(wrong))
        return FAILED
    except SystemExit as exit_:  # --help
        return int(exit_.code or 0)
    return 0
