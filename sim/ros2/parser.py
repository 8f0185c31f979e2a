"""The parser of all ros2 commands, and their execution."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from sim.ros2.group import USAGE_ERROR, Parser, UsageError, build_parser
from sim.ros2.system import CliError, Output, System
from sim.ros2.verbs import echo, pkg_create, publishing  # noqa: F401  (each adds verbs to a group, in this order)
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


def make_parser(make_completer: Callable[..., Any] = lambda *_: None) -> Parser:
    """The parser of all commands; see `build_parser`."""
    return build_parser(GROUPS, make_completer)


def execute(
    parser: Parser,
    arguments: list[str] | None,
    system: Callable[[], AbstractContextManager[System]],
    print_line: Callable[[str], None],
    print_error: Callable[[str], None],
) -> int:
    """Execute a command; returns its exit status.

    arguments: those after "ros2"; None for those of the command line. system: opens the system that the
    command inspects. print_line: prints a line of the output. print_error: prints an error.
    """
    try:
        options = parser.parse_args(arguments)
        if "function" not in options:
            parser.print_help()
        elif options.without_system:
            options.function(Output(print_line), options)
        else:
            with system() as opened:
                options.function(opened, options)
    except UsageError as error:
        print_error(str(error))
        return USAGE_ERROR
    except CliError as error:
        print_error(str(error))
        return FAILED
    except SystemExit as exit_:  # --help
        return int(exit_.code or 0)
    return 0
