"""Preemption of threads between two statements of the student's code, in another order than the usual one.

All fibers share one thread, so one is preempted where its code says so. For the time of a run, a call is
inserted before each statement of the student's functions; lines and tracebacks stay as they are.
"""

from __future__ import annotations
import __future__

import ast
import builtins
import linecache
import sys
from collections.abc import Iterator, Sequence
from types import CodeType, FunctionType
from typing import Any

from sim.ros.fibers.scheduler import engine
from sim.ros.recorder.tracebacks import is_library

POINT = "__preemption_point__"
_FUTURES = 0
for _name in __future__.all_feature_names:
    _FUTURES |= getattr(__future__, _name).compiler_flag

_rewritten: dict[CodeType, CodeType | None] = {}


def point(line: int) -> None:
    """Called before the statement at this line of a student's function: here its thread may be preempted."""
    run = engine()
    if run is not None and run.choices is not None and run.current.process.fibers_alive > 1:
        run.preemption_point(sys._getframe(1).f_code.co_qualname, line)


class Preemption:
    """The student's functions of one run, each with calls of `point` until `restore`."""

    def __init__(self, targets: Sequence[Any]) -> None:
        builtins.__dict__[POINT] = point
        self._originals: list[tuple[FunctionType, CodeType]] = []
        for function in _functions_around(targets):
            code = _with_points(function.__code__)
            if code is not None:
                self._originals.append((function, function.__code__))
                function.__code__ = code

    def restore(self) -> None:
        """Give the functions their own code again."""
        for function, code in self._originals:
            function.__code__ = code
        self._originals.clear()


def _functions_around(targets: Sequence[Any]) -> Iterator[FunctionType]:
    """The functions and methods of the modules and cells in which these classes and functions are."""
    seen: set[int] = set()
    waiting = list(targets)
    for target in targets:
        names = getattr(target, "__globals__", None) or vars(
            sys.modules.get(_text(target, "__module__"), object)
        )
        waiting += list(names.values())
    while waiting:
        found = waiting.pop()
        if id(found) in seen:
            continue
        seen.add(id(found))
        if type(found) is FunctionType:  # not isinstance: that asks the object, which may be a student's
            waiting += [found.__wrapped__] if hasattr(found, "__wrapped__") else []
            if not is_library(found.__code__.co_filename):
                yield found
        elif issubclass(type(found), type) and not _of_library(found):
            waiting += [part for base in found.__mro__ if not _of_library(base) for part in _parts(base)]


def _text(target: Any, name: str) -> str:
    found = getattr(target, name, "")
    return found if isinstance(found, str) else ""


def _of_library(class_: type) -> bool:
    module = sys.modules.get(_text(class_, "__module__"))
    file = getattr(module, "__file__", None)
    return module is None or (file is None and module.__name__ != "__main__") or is_library(file or "")


def _parts(class_: type) -> Iterator[Any]:
    for part in vars(class_).values():
        if type(part) is property:
            yield from filter(None, (part.fget, part.fset, part.fdel))
        elif type(part) in (staticmethod, classmethod):
            yield part.__func__
        else:
            yield part


def _with_points(code: CodeType) -> CodeType | None:
    """The same code with points; None where its source is not known, or has changed since."""
    if code not in _rewritten:
        _rewritten[code] = None
        source = "".join(linecache.getlines(code.co_filename))
        try:
            tree = _AddPoints().visit(ast.parse(source))
            flags = code.co_flags & _FUTURES
            whole = compile(tree, code.co_filename, "exec", flags=flags, dont_inherit=True)
        except (SyntaxError, ValueError):
            return None
        same = (code.co_qualname, code.co_firstlineno, code.co_freevars)
        for found in _codes(whole):
            if (found.co_qualname, found.co_firstlineno, found.co_freevars) == same:
                _rewritten[code] = found
    return _rewritten[code]


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


class _AddPoints(ast.NodeTransformer):
    """Adds a call before each statement inside a function, other than its docstring."""

    _inside = False

    def _function(self, node: Any) -> Any:
        before, self._inside = self._inside, True
        docstring = [] if ast.get_docstring(node, clean=False) is None else node.body[:1]
        node.body = docstring + self._block(node.body[len(docstring) :])
        self._inside = before
        return node

    visit_FunctionDef = visit_AsyncFunctionDef = _function

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.ClassDef:
        before, self._inside = self._inside, False
        self.generic_visit(node)
        self._inside = before
        return node

    def generic_visit(self, node: ast.AST) -> ast.AST:
        for name, value in ast.iter_fields(node):
            if isinstance(value, list) and value and isinstance(value[0], ast.stmt):
                setattr(node, name, self._block(value))
            elif isinstance(value, list):
                for item in value:
                    if isinstance(item, ast.AST):
                        self.visit(item)
            elif isinstance(value, ast.AST):
                self.visit(value)
        return node

    def _block(self, statements: list[ast.stmt]) -> list[ast.stmt]:
        block: list[ast.stmt] = []
        for statement in statements:
            if self._inside:
                call = ast.Call(ast.Name(POINT, ast.Load()), [ast.Constant(statement.lineno)], [])
                block.append(ast.fix_missing_locations(ast.copy_location(ast.Expr(call), statement)))
            block.append(self.visit(statement))
        return block
