"""A group of verbs such as `ros2 topic ...`: what each is called, takes and does."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple, NoReturn

from sim.ros2.system import System, Wrong
from sim.suggestions import closest_match

Work = Callable[[System, argparse.Namespace], None]
# What a terminal completes a word to, from the system (None where a verb is alone) and the words before it.
Offers = Callable[[Any, argparse.Namespace], list[str]]
WRONG_WORDS = 2  # exit status, as argparse's


class Argument(NamedTuple):
    """One word or option of a verb, as `ArgumentParser.add_argument` takes it."""

    names: tuple[str, ...]
    settings: dict[str, Any]
    offers: Offers | None


def argument(
    *names: str, offers: Offers | None = None, **settings: Any
) -> Argument:
    """See `Argument`."""
    return Argument(names, settings, offers)


def flag(*names: str, help: str) -> Argument:
    """An option without a value."""
    return argument(*names, action="store_true", help=help)


class Verb(NamedTuple):
    """One verb: what is done, and what it takes."""

    work: Work
    arguments: tuple[Argument, ...]
    alone: bool  # it is about no system


@dataclass
class Group:
    """Some verbs on one subject; without a subject's verbs, one word such as `ros2 doctor`."""

    name: str
    help: str
    verbs: dict[str, Verb] = field(default_factory=dict)

    def verb(self, name: str, *arguments: Argument, alone: bool = False) -> Callable[[Work], Work]:
        """Add a verb; its docstring is its help. An empty name makes it the group's only one.

        alone: it is about no system, and is given a `Voice` instead of one.
        """

        def add(work: Work) -> Work:
            self.verbs[name] = Verb(work, arguments, alone)
            return work

        return add


class WrongWords(Wrong):
    """The words can't be read."""


class Parser(argparse.ArgumentParser):
    """Raises what argparse would exit with, and names the word that was probably meant."""

    def error(self, message: str) -> NoReturn:
        """As `ArgumentParser`, but raises `WrongWords`."""
        raise WrongWords(f"{self.format_usage()}{self.prog}: error: {message}")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            near = closest_match(str(value), [str(choice) for choice in action.choices])
            hint = f" Did you mean {near}?" if near else ""
            choices = ", ".join(map(str, action.choices))
            raise argparse.ArgumentError(action, f"there is no {value!r}, only {choices}.{hint}")


def parser_of(groups: list[Group], offered: Callable[..., Any]) -> Parser:
    """The parser of all words; what it reads has the verb's work as `work`.

    offered: makes what argcomplete asks of what an argument offers, and of whether its verb is alone.
    """
    parser = Parser(prog="ros2", description="Look into a running ROS 2 system, and speak to it.")
    words = parser.add_subparsers(metavar="COMMAND", dest="command", parser_class=Parser)
    for group in groups:
        below = words.add_parser(group.name, help=group.help, description=group.help)
        verbs = None
        for name, verb in group.verbs.items():
            if name:
                verbs = verbs or below.add_subparsers(
                    metavar="VERB", dest="verb", required=True, parser_class=Parser
                )
                text = (verb.work.__doc__ or "").split("\n\n")[0]
                verb_parser = verbs.add_parser(name, help=text, description=text)
            else:
                verb_parser = below
            verb_parser.set_defaults(work=verb.work, alone=verb.alone)
            for names, settings, offers in verb.arguments:
                action = verb_parser.add_argument(*names, **settings)
                if offers is not None:
                    action.completer = offered(offers, verb.alone)  # type: ignore[attr-defined]
    return parser
