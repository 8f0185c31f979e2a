"""Reads a CMakeLists.txt as data: its commands in order, with variables expanded. Nothing is run.

Commands in a condition count if it holds, as far as it is made of constants and variables of this file.
Loops and functions are not followed: what is in them does not count.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from grader.checks.check import Missed

MOST, LONGEST = 20_000, 5_000  # bytes of the file, characters of a command with its variables
_TOKEN = re.compile(
    r"(?P<left>\s+|#\[(?P<signs>=*)\[.*?\](?P=signs)\]|#(?!\[=*\[)[^\n]*)"
    r'|"(?P<quoted>(?:[^"\\]|\\.)*)"'
    r"|\[(?P<equal>=*)\[(?P<bracket>.*?)\](?P=equal)\]"
    r"|(?P<round>[()])"
    r'|(?P<plain>[^\s()#"]+)',
    re.S,
)
OPENING = ("if", "foreach", "while", "function", "macro", "block")
CLOSING = tuple(f"end{name}" for name in OPENING)
_TRUE = re.compile(r"1|on|yes|true|y|[1-9]\d*", re.I)
_FALSE = re.compile(r"0|off|no|false|n|ignore|notfound|.*-notfound", re.I)
_VARIABLE = re.compile(r"\$\{(\w+)\}")


@dataclass(frozen=True)
class CMakeCommand:
    """A command in small letters, and its arguments."""

    name: str
    words: tuple[str, ...]


def read_commands(data: bytes) -> list[CMakeCommand]:
    """The commands of a CMakeLists.txt, in order. Raises Missed where it can't be read."""
    if len(data) > MOST:
        raise _unread(f"{len(data)} bytes", f"More than {MOST} bytes are not read: make it shorter.")
    known: dict[str, str] = {}
    read = []
    blocks = Blocks()
    for name, words in _written(data.decode("utf-8-sig", errors="replace")):
        command = CMakeCommand(name, tuple(_put_in(words, known)))
        if blocks.skips(command, known):
            continue
        if name == "return" or (name, *command.words[:1]) == ("message", "FATAL_ERROR"):
            break
        read.append(command)
        match command:
            case CMakeCommand("project", (first, *_)):
                known["PROJECT_NAME"] = first
            case CMakeCommand("set", (variable, *values)):
                known[variable] = ";".join(values)
            case CMakeCommand("list", ("APPEND", variable, *values)):
                known[variable] = ";".join([*filter(None, [known.get(variable)]), *values])
    return read


class Blocks:
    """The blocks around a command, from the outermost: whether commands in each of them are executed."""

    def __init__(self) -> None:
        self._executed: list[bool] = []
        self._done: list[bool] = []  # whether a branch of the condition was executed

    def skips(self, command: CMakeCommand, known: Mapping[str, str]) -> bool:
        """Return whether the command is not executed, or begins, divides or ends a block."""
        name, words = command.name, command.words
        if name in OPENING:
            holds = name == "block" or (name == "if" and _holds(words, known))
            self._executed.append(holds)
            self._done.append(holds)
        elif name in ("elseif", "else") and self._executed:
            holds = not self._done[-1] and (name == "else" or _holds(words, known))
            self._executed[-1] = holds
            self._done[-1] |= holds
        elif name in CLOSING and self._executed:
            self._executed.pop()
            self._done.pop()
        else:
            return not all(self._executed)
        return True


def _holds(words: Sequence[str], known: Mapping[str, str]) -> bool:
    """Return whether a condition of constants, variables, NOT, AND and OR holds; False for any other one."""
    return any(_all_hold(part, known) for part in _split(words, "OR"))


def _all_hold(words: Sequence[str], known: Mapping[str, str]) -> bool:
    parts = _split(words, "AND")
    return all(_is_simple(part) and _is_true(part[-1], known) != (len(part) == 2) for part in parts)


def _split(words: Iterable[str], between: str) -> list[list[str]]:
    """The parts between words such as AND."""
    groups = itertools.groupby(words, lambda word: word == between)
    return [list(part) for is_between, part in groups if not is_between]


def _is_simple(words: Sequence[str]) -> bool:
    """Return whether it is a word, or NOT and a word."""
    return len(words) == 1 or (len(words) == 2 and words[0] == "NOT")


def _is_true(word: str, known: Mapping[str, str]) -> bool:
    """Return whether a constant or a variable is true; a variable that this file does not set is not."""
    value = known.get(word, "")
    return bool(_TRUE.fullmatch(word) or (value and not _FALSE.fullmatch(value)))


def _put_in(words: list[str], known: dict[str, str]) -> Iterator[str]:
    """The words with variables. One with ; becomes several, since that is how commands take lists."""
    size = 0
    for word in words:
        whole = _VARIABLE.sub(lambda found: known.get(found[1], ""), word)
        size += len(whole)
        if size > LONGEST:  # a few lines can say more than fits into any memory
            raise _unread(f"a command with {size} characters", f"More than {LONGEST} are not read.")
        yield from filter(None, whole.split(";"))


def _written(text: str) -> Iterator[tuple[str, list[str]]]:
    """Each command's name, and its words as they are written, without quotes."""
    name, depth = "", 0
    words: list[str] = []
    for kind, value, line in _tokens(text):
        if kind == "plain" and not name:
            name, words = value.lower(), []
        elif kind == "round" and value == "(" and name:
            depth += 1
        elif kind == "round" and value == ")" and depth:
            depth -= 1
            if depth == 0:
                yield name, words
                name = ""
        elif depth:
            words.append(value)
        else:
            hint = "A command such as project(...) should begin there."
            raise _unread(f"{value[:40]} in line {line}", hint)
    if name:
        raise _unread(
            f"{name[:40]} without {')' if depth else '(...)'}", "Close the command with its parenthesis."
        )


def _tokens(text: str) -> Iterator[tuple[str, str, int]]:
    """Kind, value and line of each token."""
    at = 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            line = text.count("\n", 0, at) + 1
            raise _unread(
                f"{text[at : at + 20]!r} in line {line}",
                "Something begins there and never ends: close the quote or bracket.",
            )
        kind = str(found.lastgroup)  # all alternatives are groups
        if kind != "left":
            yield kind, found[kind], text.count("\n", 0, at) + 1
        at = found.end()


def _unread(saw: str, hint: str) -> Missed:
    return Missed("a CMakeLists.txt that can be read", saw, hint)
