"""Near misses in a package's files: the corrected package is built, and earns half of the points."""

from __future__ import annotations

import ast
import functools
import pkgutil
import re
from collections.abc import Callable, Iterable, Mapping

from grader.workspace.sources import Sources
from sim.suggestions import closest_match

Correction = Callable[[Sources], Mapping[str, bytes]]
"""Returns the files that a package should have in place of its own; none where it finds no near miss."""

MAIN = "main"
_POINT = re.compile(r"""(["'])([\w-]+)(\s*=\s*)([A-Za-z_]\w*(?:\.\w+)+)(?::(\w+))?\1""")
_JOINED = re.compile(r"""(=\s*[\w.:]+["'])(\s*["'][\w-]+\s*=)""")
_PAIRS = re.compile(r"(\))(\s*\n\s*\()")
_ARGUMENTS = re.compile(r"""([\])'"\w])(\s*\n\s*\w+=)""")
_EXECUTABLE = re.compile(r"""(executable\s*=\s*["'])([\w-]+)(?=["'])""")


def entry_points(sources: Sources, commands: Iterable[str] = ()) -> dict[str, bytes]:
    """Entry points of setup.py without a function, with a misspelt main, or with a misspelt command.

    commands: those that the task wants.
    """
    complete = functools.partial(_complete, sources, list(commands))
    return _replaced(sources, "/setup.py", _POINT, complete)


def commas(sources: Sources) -> dict[str, bytes]:
    """Commas that are missing in setup.py: between entry points, between pairs, and after an argument."""
    return {path: _with_commas(text).encode() for path, text in _texts(sources, "/setup.py")}


def _with_commas(text: str) -> str:
    text = _PAIRS.sub(r"\1,\2", _JOINED.sub(r"\1,\2", text))
    return text if _can_be_parsed(text) else _ARGUMENTS.sub(r"\1,\2", text)


def _can_be_parsed(text: str) -> bool:
    try:
        ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return True


def executables(sources: Sources) -> dict[str, bytes]:
    """Misspelt commands of the package in its launch files."""
    known = [found[2] for path, text in _texts(sources, "/setup.py") for found in _POINT.finditer(text)]

    def correct(found: re.Match[str]) -> str:
        name = found[2]
        return found[1] + (name if name in known else closest_match(name, known) or name)

    return _replaced(sources, ".launch.py", _EXECUTABLE, correct)


def judge_only(name: str) -> Correction:
    """A correction that students don't have, because it holds the answer: "module:function".

    Beside a student's notebook it corrects nothing.
    """

    def correct(sources: Sources) -> Mapping[str, bytes]:
        try:
            corrected: Mapping[str, bytes] = pkgutil.resolve_name(name)(sources)
            return corrected
        except ModuleNotFoundError:
            return {}

    return correct


def corrected(sources: Sources, corrections: Iterable[Correction]) -> dict[str, bytes] | None:
    """Return the sources with all corrections made; None where that changes nothing."""
    made = dict(sources)
    for correction in corrections:
        made.update(correction(made))
    return None if made == dict(sources) else made


def _complete(sources: Sources, commands: list[str], found: re.Match[str]) -> str:
    quote, name, sign, module, function = found.groups()
    defined = {each for _, text in _texts(sources, ".py") for each in re.findall(r"^def (\w+)", text, re.M)}
    if function is None or (function not in defined and closest_match(function, [MAIN])):
        function = MAIN
    name = name if name in commands else closest_match(name, commands) or name
    return f"{quote}{name}{sign}{module}:{function}{quote}"


def _texts(sources: Sources, ending: str) -> Iterable[tuple[str, str]]:
    found = {path: data for path, data in sources.items() if path.endswith(ending)}
    return [(path, data.decode("utf-8", "replace")) for path, data in found.items()]


def _replaced(
    sources: Sources, ending: str, pattern: re.Pattern[str], correct: Callable[[re.Match[str]], str]
) -> dict[str, bytes]:
    return {path: pattern.sub(correct, text).encode() for path, text in _texts(sources, ending)}
