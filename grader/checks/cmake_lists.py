"""Reads a CMakeLists.txt as data: its commands in order, with variables expanded. Nothing is run.

Conditions, loops and functions are not followed: each command counts on its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
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
    for name, words in _written(data.decode("utf-8-sig", errors="replace")):
        command = CMakeCommand(name, tuple(_put_in(words, known)))
        read.append(command)
        match command:
            case CMakeCommand("project", (first, *_)):
                known["PROJECT_NAME"] = first
            case CMakeCommand("set", (variable, *values)):
                known[variable] = ";".join(values)
            case CMakeCommand("list", ("APPEND", variable, *values)):
                known[variable] = ";".join([*filter(None, [known.get(variable)]), *values])
    return read


def _put_in(words: list[str], known: dict[str, str]) -> Iterator[str]:
    """The words with variables. Where ; stands in one it becomes several: so commands take lists."""
    size = 0
    for word in words:
        whole = _VARIABLE.sub(lambda found: known.get(found[1], ""), word)
        size += len(whole)
        if size > LONGEST:  # a few lines can say more than fits into any memory
            raise _unread(f"a command with {size} characters", f"More than {LONGEST} are not read.")
        yield from filter(None, whole.split(";"))


def _written(text: str) -> Iterator[tuple[str, list[str]]]:
    """Each command's name, and its words as they are written, without quotes."""
    name, words, depth = "", [], 0
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
            hint = "There a command should begin, such as project(...)."
            raise _unread(f"{value[:40]} in line {line}", hint)
    if name:
        raise _unread(f"{name[:40]} without {')' if depth else '(...)'}", "A command ends with its bracket.")


def _tokens(text: str) -> Iterator[tuple[str, str, int]]:
    """Kind, value and line of each token."""
    at = 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            line = text.count("\n", 0, at) + 1
            raise _unread(f"{text[at : at + 20]!r} in line {line}", "What begins there has no end.")
        if found.lastgroup != "left":
            yield found.lastgroup, found[found.lastgroup], text.count("\n", 0, at) + 1
        at = found.end()


def _unread(saw: str, hint: str) -> Missed:
    return Missed("a CMakeLists.txt that can be read", saw, hint)
