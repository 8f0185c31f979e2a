"""Sequences of a program's syntax tree, in which names, texts, numbers and comments don't appear."""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Iterable, Iterator

LENGTH = 6  # kinds of nodes in one sequence
MAGIC = re.compile(r"^(\s*)[%!].*$", re.M)  # IPython's own lines
CELL_MAGIC = re.compile(r"\A\s*%%.*\n?")
LEFT_OUT = ast.expr_context | ast.alias | ast.Import | ast.ImportFrom
Grams = frozenset[int]


def grams(sources: Iterable[str]) -> Grams:
    """The sequences in these cells or files, as hashes. What isn't Python counts for nothing."""
    found: set[int] = set()
    for source in sources:
        for block in _blocks(source):
            kinds = list(_kinds(block))
            found |= {hash(tuple(kinds[i : i + LENGTH])) for i in range(len(kinds) - LENGTH + 1)}
    return frozenset(found)


def python_of(source: str) -> str:
    """The Python in a cell: without lines that only IPython understands; a file that it writes is one."""
    return MAGIC.sub(r"\1pass", CELL_MAGIC.sub("", source))


def is_python(source: str) -> bool:
    """Return whether Python understands it."""
    return _parsed(source) is not None


def _parsed(source: str) -> ast.Module | None:
    try:
        with warnings.catch_warnings(action="ignore"):  # of texts such as "\d"
            return ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _blocks(source: str) -> Iterator[ast.AST]:
    """The functions of a program, and what is around them: their order doesn't matter."""
    for node in ast.walk(_parsed(python_of(source)) or ast.Module([], [])):
        if isinstance(node, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef):
            yield node


def _kinds(block: ast.AST) -> Iterator[int]:
    """The kinds of nodes in the order of the source, without the functions inside, which are blocks, too."""
    left = [block]
    while left:
        node = left.pop()
        if isinstance(node, LEFT_OUT) or (_is_docstring(node)):
            continue
        yield KINDS.setdefault(type(node), len(KINDS))
        if node is block or not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            left += reversed(list(ast.iter_child_nodes(node)))


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


KINDS: dict[type, int] = {}  # numbers instead of types: their hashes are the same in each process


def overlap(first: Grams, second: Grams) -> float:
    """The part of the smaller program that is in the other one, from 0 to 1."""
    least = min(len(first), len(second))
    return len(first & second) / least if least else 0.0


