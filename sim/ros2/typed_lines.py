"""Text with the commands that were typed in several terminals, read line by line and word by word.

A line such as "# terminal 2" says where the lines below it were typed; other comments are left out.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from typing import NamedTuple

HEADING = re.compile(r"#+\s*terminal\s+(\w+)\W*", re.IGNORECASE)
IN_SINGLE_QUOTES = re.compile(r"'[^']*'")
OPERATORS = frozenset("();<>|&")
# What only a shell understands, and what to type instead.
LINES, VALUE = "type each command on a line of its own", "type the value itself"
OUTPUT, ANOTHER = "leave it out", "open another terminal for the next command"
INSTEAD = dict.fromkeys(("&&", ";", "||"), LINES) | dict.fromkeys("$`", VALUE)
INSTEAD |= dict.fromkeys(("|", ">", ">>", "2>", "<"), OUTPUT) | {"&": ANOTHER}
LONGEST = 30  # lines of one command
QUOTES = "put quotes round a value that has it"


class InvalidLine(Exception):
    """A line that can't be executed. The message is what the terminal prints."""


class Line(NamedTuple):
    """A command. number: of its first line in the text, from 1 on. terminal: its name."""

    number: int
    terminal: str
    text: str


def lines_of(text: str) -> Iterator[Line]:
    """The commands of a text. After an open quote or a backslash, one continues in the next line.

    One of more lines than any message needs ends there, and its quote is open: each line is read again with
    those that come after it.
    """
    terminal, typed, first = "1", "", 1
    for number, line in enumerate(text.splitlines(), 1):
        first = first if typed else number
        typed += f"{line}\n"
        if number - first < LONGEST and (typed.endswith("\\\n") or _is_open(typed)):
            continue
        heading = HEADING.fullmatch(typed.strip())
        terminal = heading[1] if heading else terminal
        yield from _commands(first, terminal, typed)
        typed = ""
    yield from _commands(first, terminal, typed)


def _commands(number: int, terminal: str, typed: str) -> Iterator[Line]:
    command = typed.replace("\\\n", " ").strip().removeprefix("$ ")
    if command and not command.startswith("#"):
        yield Line(number, terminal, command)


def _is_open(typed: str) -> bool:
    try:
        shlex.split(typed, comments=True)
    except ValueError:
        return True
    return False


def words_of(command: str) -> list[str]:
    """The words of a command. Raises InvalidLine if it can't be read, or only by a shell."""
    reader = shlex.shlex(command, posix=True, punctuation_chars=True)
    reader.whitespace_split = True
    try:
        words = list(reader)
    except ValueError as error:
        raise InvalidLine(f"bash: {error}: a quote that is opened has to be closed") from None
    found = [word for word in words if word and OPERATORS.issuperset(word)]
    found += re.findall(r"[$`]", IN_SINGLE_QUOTES.sub("", command))
    if found:
        instead = INSTEAD.get(found[0], QUOTES)
        raise InvalidLine(f"`{found[0]}` needs a shell, but there is none here: {instead}")
    return words
