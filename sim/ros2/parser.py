"""The parser of all ros2 commands, and their execution."""

from __future__ import annotations

import importlib
import os
import sys
from argparse import Namespace
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import Any

from sim.ros.bags.bag_error import BagError
from sim.ros2.discovery_options import discovery_options
from sim.ros2.group import USAGE_ERROR, Group, Parser, UsageError, build_parser
from sim.ros2.system import CliError, Output, System

# The modules in `verbs` that add verbs to a command, in this order, and the command's help.
COMMANDS: dict[str, tuple[tuple[str, ...], str]] = {
    "action": (("action",), "Actions: list them, send a goal"),
    "bag": (("bag", "bag_play"), "Bags: record messages, inspect them, play them back"),
    "doctor": (("doctor", "hello"), "Check ROS setup and other potential issues"),
    "interface": (("interface",), "Types of messages, services and actions"),
    "launch": (("launch",), "Run a launch file"),
    "lifecycle": (("lifecycle",), "Nodes with a lifecycle: their states and transitions"),
    "node": (("node",), "Nodes: list them, show how each is connected"),
    "param": (("param",), "Parameters of nodes: list, get, set, describe, dump, load"),
    "pkg": (("pkg", "pkg_create"), "Various package related sub-commands"),
    "run": (("run",), "Run a package specific executable"),
    "service": (("service", "service_echo"), "Services: list them, call one"),
    "topic": (("topic", "echo", "publishing"), "Topics: list, echo, measure, publish"),
    "wtf": (("doctor", "hello"), "Use `wtf` as alias to `doctor`"),
}
FAILED = 1  # exit status


def load_group(name: str, verb: str = "") -> Group:
    """The verbs of a command. verb: the only one that is needed, if the command has it; "" for all."""
    first, *others = COMMANDS[name][0]
    group: Group = getattr(importlib.import_module(f"sim.ros2.verbs.{first}"), name)
    for module in others:
        if not verb or verb not in group.verbs:
            importlib.import_module(f"sim.ros2.verbs.{module}")
    return group


def make_parser(make_completer: Callable[..., Any] = lambda *_: None, typed: Sequence[str] = ()) -> Parser:
    """The parser of all commands; see `build_parser`. typed: the one command that is needed, and its verb."""
    command, verb = (*typed, "", "")[:2]
    groups = [
        load_group(name, verb) if not typed or command == name else Group(name, help)
        for name, (_, help) in COMMANDS.items()
    ]
    return build_parser(groups, make_completer, discovery_options)


def typed_words() -> list[str]:
    """The command and its verb on the command line; the command alone in a line that the shell completes."""
    line = os.environ.get("COMP_LINE")
    return (sys.argv[1:3] or [""]) if line is None else (line.split()[1:2] or [""])


def execute(
    parser: Parser,
    arguments: list[str] | None,
    system: Callable[[Namespace], AbstractContextManager[System]],
    print_line: Callable[[str], None],
    print_error: Callable[[str], None],
) -> int:
    """Execute a command; returns its exit status.

    arguments: those after "ros2"; None for those of the command line. system: opens the system that
    a command with these options inspects. print_line: prints a line of the output. print_error: prints an
    error.
    """
    try:
        options = parser.parse_args(arguments)
        if "function" not in options:
            parser.print_help()
        elif options.without_system:
            options.function(Output(print_line), options)
        else:
            with system(options) as opened:
                options.function(opened, options)
    except UsageError as error:
        print_error(str(error))
        return USAGE_ERROR
    except (CliError, BagError) as error:
        print_error(str(error))
        return FAILED
    except SystemExit as exit_:  # --help
        return int(exit_.code or 0)
    return 0
