"""A group of verbs such as `ros2 topic ...`: their names, arguments and functions."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, NamedTuple, NoReturn

from sim.ros2.absent import absent_command, absent_option
from sim.ros2.system import CliError
from sim.suggestions import closest_match

VerbFunction = Callable[[Any, argparse.Namespace], None]  # gets a System; an Output if without_system
# Returns completions of an argument, from the system (None if without_system) and the arguments before it.
Completer = Callable[[Any, argparse.Namespace], list[str]]
USAGE_ERROR = 2  # exit status, as argparse's
# Values without quotes, which the shell splits at their spaces: {linear: {x: 0.5}}, or data: Hello
UNQUOTED = re.compile(r"unrecognized arguments: (.*\}|[^-]\S*)$")
QUOTES = '\nA value with spaces needs quotes around it: "{linear: {x: 0.5}}".'


class Argument(NamedTuple):
    """One argument or option of a verb, as for `ArgumentParser.add_argument`, and its completer."""

    names: tuple[str, ...]
    settings: dict[str, Any]
    completer: Completer | None


def argument(*names: str, completer: Completer | None = None, **settings: Any) -> Argument:
    """See `Argument`."""
    return Argument(names, settings, completer)


def flag(*names: str, help: str) -> Argument:
    """An option without a value."""
    return argument(*names, action="store_true", help=help)


class Verb(NamedTuple):
    """One verb."""

    function: VerbFunction
    arguments: tuple[Argument, ...]
    without_system: bool


@dataclass
class Group:
    """The verbs of one command; one without a name is the command itself, such as `ros2 doctor`."""

    name: str
    help: str
    verbs: dict[str, Verb] = field(default_factory=dict)

    def verb(
        self, name: str, *arguments: Argument, without_system: bool = False
    ) -> Callable[[VerbFunction], VerbFunction]:
        """Add a verb, whose help is the function's docstring. An empty name makes it the command itself.

        without_system: the function needs no system, and gets an `Output` instead of one.
        """

        def add(function: VerbFunction) -> VerbFunction:
            self.verbs[name] = Verb(function, arguments, without_system)
            return function

        return add


class UsageError(CliError):
    """The arguments are invalid."""


class Parser(argparse.ArgumentParser):
    """Raises an exception where argparse exits, and suggests the correct argument for a misspelt one."""

    def parse_args(self, args: Iterable[str] | None = None, namespace: Any = None) -> Any:
        """Work like `ArgumentParser.parse_args`; name what the official command has and this one lacks."""
        options, unknown = self.parse_known_args(args, namespace)
        words = f"{options.command or ''} {getattr(options, 'verb', None) or ''}".strip()
        for option in unknown:
            if absent := absent_option(words, option):
                raise UsageError(absent)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return options

    def error(self, message: str) -> NoReturn:
        """Work like `ArgumentParser.error`, but raises `UsageError`."""
        quotes = QUOTES if UNQUOTED.match(message) else ""
        raise UsageError(f"{self.format_usage()}{self.prog}: error: {message}{quotes}")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            absent = absent_command(f"{self.prog.partition(' ')[2]} {value}".strip())
            if absent and action.dest in ("command", "verb"):
                raise UsageError(absent)
            near = closest_match(str(value), [str(choice) for choice in action.choices])
            hint = f" Did you mean {near}?" if near else ""
            choices = ", ".join(map(str, action.choices))
            raise argparse.ArgumentError(action, f"there is no {value!r}, only {choices}.{hint}")


def build_parser(
    groups: list[Group],
    make_completer: Callable[..., Any],
    more_options: Callable[[str], tuple[Argument, ...]] = lambda _: (),
) -> Parser:
    """The parser of all groups. In its result, `function` is the verb's function.

    make_completer: returns argcomplete's completer, from that of an argument and its verb's `without_system`.
    more_options: those that a command and verb, such as "topic echo", has in addition.
    """
    parser = Parser(prog="ros2", description="Inspect a running ROS 2 system, and interact with it.")
    commands = parser.add_subparsers(metavar="COMMAND", dest="command", parser_class=Parser)
    for group in groups:
        command = commands.add_parser(group.name, help=group.help, description=group.help)
        verbs = None
        for name, verb in group.verbs.items():
            if name:
                needed = "" not in group.verbs
                verbs = verbs or command.add_subparsers(
                    metavar="VERB", dest="verb", required=needed, parser_class=Parser
                )
                text = (verb.function.__doc__ or "").split("\n\n")[0]
                verb_parser = verbs.add_parser(name, help=text, description=text)
            else:
                verb_parser = command
            verb_parser.set_defaults(function=verb.function, without_system=verb.without_system)
            for names, settings, completer in (*verb.arguments, *more_options(f"{group.name} {name}")):
                action = verb_parser.add_argument(*names, **settings)
                if completer is not None:
                    made = make_completer(completer, verb.without_system)
                    action.completer = made  # type: ignore[attr-defined]
    return parser
