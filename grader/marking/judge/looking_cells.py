"""Which cells of a notebook only look at a run: marking leaves them out, for the tests look themselves."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from symtable import SymbolTable, symtable

RUNS = {"run", "packages.see"}  # what a cell calls that looks at a run
ROS2 = re.compile(r"^%ros2\b.*$", re.M)  # speaks of the last run
# With one of these a cell may use a name that it does not show.
HIDDEN = {"eval", "exec", "globals", "locals", "vars", "get_ipython"}


@dataclass(frozen=True)
class Look:
    """What a cell that looks at a run makes and uses: names of the notebook."""

    makes: Set[str]
    uses: Set[str]
    runs: bool


def looking_cells(sources: Sequence[str], ours: Set[int]) -> set[int]:
    """Places of the cells whose run nothing else in the notebook needs.

    sources: of all code cells. ours: places of the release's cells that the student left as they were,
    other than answers and tests. Such a cell runs something, or uses what one that does has made; it changes
    nothing but names, and no cell that is run uses one of these.
    """
    looks = {cell: look for cell in ours if (look := _look(sources[cell])) is not None}
    while True:
        found = _looking(looks)
        needed = {name for cell, source in enumerate(sources) if cell not in found for name in _used(source)}
        kept = {cell for cell in found if looks[cell].makes & needed}
        if not kept:
            return found
        looks = {cell: look for cell, look in looks.items() if cell not in kept}


def _looking(looks: Mapping[int, Look]) -> set[int]:
    """Those that run something, and those that use what one of these has made."""
    found: set[int] = set()
    made: set[str] = set()
    while more := {cell for cell, it in looks.items() if it.runs or it.uses & made} - found:
        found |= more
        made = {name for cell in found for name in looks[cell].makes}
    return found


def _look(source: str) -> Look | None:
    """None for what may change more than the names that it makes, or makes some in rare ways."""
    try:
        tree = ast.parse(ROS2.sub("", source))
    except (SyntaxError, ValueError):  # a command of IPython's, such as %matplotlib
        return None
    if any(_changes(node) for node in _outside_functions(tree)):
        return None
    called = {ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)}
    return Look(set(_made(tree)), _used(source), bool(RUNS & called or ROS2.search(source)))


def _made(tree: ast.Module) -> Iterator[str]:
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
    """All that is done when the cell is run; of functions and classes only that they are made."""
    for node in ast.iter_child_nodes(tree):
        yield node
        if not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Lambda):
            yield from _outside_functions(node)


def _used(source: str) -> set[str]:
    """Names of the notebook that a cell may use; of one that can't be read or hides them, all its words."""
    if source.startswith("%%writefile"):
        source = source.partition("\n")[0]  # the rest is a file's
    try:
        names = set(_globals(symtable(ROS2.sub("", source), "cell", "exec")))
    except (SyntaxError, ValueError, RecursionError, MemoryError):  # %matplotlib, or brackets without end
        names = HIDDEN
    return set(re.findall(r"\w+", source)) if names & HIDDEN else names


def _globals(scope: SymbolTable) -> Iterator[str]:
    """What a cell, and each function and class in it, reads of what the notebook has."""
    ours = scope.get_type() in ("module", "class")
    yield from (
        it.get_name() for it in scope.get_symbols() if it.is_referenced() and (ours or it.is_global())
    )
    for inner in scope.get_children():
        yield from _globals(inner)
