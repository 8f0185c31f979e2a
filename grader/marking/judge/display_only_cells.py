"""Finds the cells of a notebook that only display a run. Marking skips them: its tests run the nodes."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from symtable import SymbolTable, symtable

from grader.course_files.course_notebooks import DISPLAYS

ROS2 = re.compile(r"^%ros2\b.*$", re.M)  # shows the last run
# A cell with one of these may use a name that is not in its source.
HIDDEN = {"eval", "exec", "globals", "locals", "vars", "get_ipython"}


@dataclass(frozen=True)
class DisplayCell:
    """The names that a display-only cell binds and uses, and whether it runs something."""

    binds: Set[str]
    uses: Set[str]
    runs: bool


def display_only_cells(sources: Sequence[str], released: Set[int]) -> set[int]:
    """The indices of the cells whose results no other cell of the notebook needs.

    sources: of all code cells. released: indices of the release's cells that the student did not change,
    other than answers and tests. Such a cell runs something, or uses a name that another such cell binds; it
    has no effect but binding names, and no cell that is run uses one of these.
    """
    candidates = {cell: it for cell in released if (it := _display_cell(sources[cell])) is not None}
    while True:
        found = _connected_cells(candidates)
        needed = {name for cell, source in enumerate(sources) if cell not in found for name in _used(source)}
        necessary = {cell for cell in found if candidates[cell].binds & needed}
        if not necessary:
            return found
        candidates = {cell: it for cell, it in candidates.items() if cell not in necessary}


def _connected_cells(candidates: Mapping[int, DisplayCell]) -> set[int]:
    """Those that run something, and those that use a name that one of these binds."""
    found: set[int] = set()
    bound: set[str] = set()
    while more := {cell for cell, it in candidates.items() if it.runs or it.uses & bound} - found:
        found |= more
        bound = {name for cell in found for name in candidates[cell].binds}
    return found


def _display_cell(source: str) -> DisplayCell | None:
    """None for a cell that may have other effects than binding names, or binds some in unusual ways."""
    try:
        tree = ast.parse(ROS2.sub("", source))
    except (SyntaxError, ValueError):  # a command of IPython's, such as %matplotlib
        return None
    if any(_changes(node) for node in _outside_functions(tree)):
        return None
    called = {ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    return DisplayCell(set(_bound(tree)), _used(source), bool(DISPLAYS & called or ROS2.search(source)))


def _bound(tree: ast.Module) -> Iterator[str]:
    for node in _outside_functions(tree):
        match node:
            case ast.Name(id=name, ctx=ast.Store()):
                yield name
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
                yield name
            case ast.alias(name=name, asname=asname):
                yield asname or name.partition(".")[0]


def _changes(node: ast.AST) -> bool:
    stores = isinstance(node, ast.Attribute | ast.Subscript) and not isinstance(node.ctx, ast.Load)
    return stores or isinstance(node, ast.Delete | ast.Global | ast.Try | ast.With | ast.Match)


def _outside_functions(tree: ast.AST) -> Iterator[ast.AST]:
    """All nodes that are executed when the cell is run: not the bodies of functions and classes."""
    for node in ast.iter_child_nodes(tree):
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda):
            yield from _outside_functions(node)


def _used(source: str) -> set[str]:
    """Global names that a cell may use; all its words if it is invalid Python or may use hidden names."""
    if source.startswith("%%writefile"):
        source = source.partition("\n")[0]  # the rest is the file's content
    try:
        names = set(_globals(symtable(ROS2.sub("", source), "cell", "exec")))
    except (SyntaxError, ValueError, RecursionError, MemoryError):  # %matplotlib, or brackets without end
        names = HIDDEN
    return set(re.findall(r"\w+", source)) if names & HIDDEN else names


def _globals(scope: SymbolTable) -> Iterator[str]:
    """The global names that a cell, and each function and class in it, reads."""
    outer = scope.get_type() in ("module", "class")
    yield from (
        it.get_name() for it in scope.get_symbols() if it.is_referenced() and (outer or it.is_global())
    )
    for inner in scope.get_children():
        yield from _globals(inner)
