"""The number of lines that a repaired class changes of the class that was given."""

from __future__ import annotations

import ast
import difflib
import inspect
import textwrap
from collections.abc import Mapping
from typing import Any

from grader.exercises.systems.audit.six_systems import SYSTEMS

LONGEST = 20_000  # characters of a method's source


def changed_lines(name: str, methods: Mapping[Any, Any], inherits: bool) -> int:
    """Return how many lines of a system's class are added, removed or replaced.

    methods: the sources of the repaired class's own methods. inherits: the given class has the others. Blank
    lines, comments and docstrings don't count, and neither does a call of the method that is overridden.
    Raises ValueError if a source can't be read.
    """
    node = SYSTEMS[name].node
    given = {each: inspect.getsource(part) for each, part in vars(node).items() if inspect.isfunction(part)}
    names = [*given, *(each for each in methods if each not in given)]
    count = 0
    for each in names:
        if each in methods or not inherits:
            before, after = _statements(given.get(each, "")), _statements(methods.get(each, ""))
            count += _changed(before, after, each if inherits else "")
    return count


def _statements(source: Any) -> list[str]:
    """Return the lines of a method in one form, without comments and annotations."""
    if source == "":
        return []
    try:
        (method,) = ast.parse(textwrap.dedent(str(source)[:LONGEST])).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        method = None
    if not isinstance(method, ast.FunctionDef | ast.AsyncFunctionDef):
        raise ValueError("a method that can't be read")
    for part in ast.walk(method):
        if isinstance(part, ast.FunctionDef | ast.AsyncFunctionDef):
            part.returns = None
            if ast.get_docstring(part) is not None:
                part.body[:1] = [] if len(part.body) > 1 else [ast.Pass()]
        elif isinstance(part, ast.arg):
            part.annotation = None
    return ast.unparse(method).splitlines()


def _changed(given: list[str], own: list[str], name: str) -> int:
    """Return the number of lines that differ. name: of the method, if it may call the given one."""
    inherited = f"super().{name}("
    if name and any(inherited in line for line in own):
        return sum(inherited not in line for line in own[1:])
    blocks = difflib.SequenceMatcher(None, given, own, autojunk=False).get_opcodes()
    return sum(max(i2 - i1, j2 - j1) for tag, i1, i2, j1, j2 in blocks if tag != "equal")
