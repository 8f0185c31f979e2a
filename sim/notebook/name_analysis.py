"""Static analysis of the names that a cell's code defines, and that a class or function looks up."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from types import CodeType
from typing import Any

_DEFINITION = re.compile(r"^(?:async\s+def|def|class)\s+(\w+)", re.MULTILINE)
_Function = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


def defined_names(source: str) -> set[str]:
    """The names that a cell's code assigns to a class, a function or a value.

    In code with a syntax error, the classes and functions that start a line.
    """
    return set(_bound(source, imports=False))


def bound_names(source: str) -> set[str]:
    """The defined names and the imported names."""
    return set(_bound(source, imports=True))


def is_same_code(one: str, other: str) -> bool:
    """Return whether two sources are the same code, apart from comments and blank lines."""
    try:
        return one == other or ast.dump(ast.parse(one)) == ast.dump(ast.parse(other))
    except (SyntaxError, ValueError):
        return one.split() == other.split()


def looked_up_names(thing: Any) -> Iterator[str]:
    """The global names that a class or function of a notebook may look up; none for other objects."""
    if isinstance(thing, type):
        yield from (base.__name__ for base in thing.__mro__ if base.__module__ == "__main__")
        for part in list(vars(thing).values()):
            yield from looked_up_names(part) if not isinstance(part, type) else ()
        return
    thing = getattr(thing, "__func__", getattr(thing, "fget", None) or thing)
    code = getattr(thing, "__code__", None)
    if isinstance(code, CodeType):
        yield from _names(code)


def _names(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)


def _bound(source: str, *, imports: bool) -> Iterator[str]:
    lines = source.splitlines()
    if lines and lines[0].startswith("%%"):
        return
    # IPython commands aren't Python syntax.
    python = "\n".join(re.sub(r"^(\s*)[%!?].*", r"\1pass", line) for line in lines)
    try:
        tree = ast.parse(python)
    except (SyntaxError, ValueError):
        yield from _DEFINITION.findall(source)
        return
    for node in _outside_functions(tree):
        if isinstance(node, _Function):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif imports and isinstance(node, ast.Import | ast.ImportFrom):
            yield from ((name.asname or name.name).split(".")[0] for name in node.names)


def _outside_functions(node: ast.AST) -> Iterator[ast.AST]:
    for child in ast.iter_child_nodes(node):
        yield child
        if not isinstance(child, (*_Function, ast.Lambda)):
            yield from _outside_functions(child)
