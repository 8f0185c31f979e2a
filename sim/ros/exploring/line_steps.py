"""A callback as a generator that stops before each of its statements, so that others can run in between."""

from __future__ import annotations

import ast
import contextlib
import copy
import inspect
import itertools
import textwrap
from collections.abc import Callable, Generator, Iterator
from typing import Any, NamedTuple

SILENT = ast.Pass | ast.Global | ast.Nonlocal | ast.FunctionDef | ast.ClassDef


class Stop(NamedTuple):
    """The place where a callback stops: before a line, and the locks that the statement there takes."""

    line: int
    locks: tuple[Any, ...] = ()

    @property
    def blocked(self) -> bool:
        """Return whether the statement would have to wait for a lock."""
        return any(lock.locked() for lock in self.locks if hasattr(lock, "locked"))


def source_lines(method: Callable[..., Any]) -> list[tuple[int, str]]:
    """Return the lines of a method and their numbers, without indentation; none if there is no source."""
    try:
        lines, first = inspect.getsourcelines(method)
    except (OSError, TypeError):
        return []
    return list(enumerate(textwrap.dedent("".join(lines)).rstrip().splitlines(), first))


def in_lines(method: Any, *arguments: Any) -> Generator[Stop, None, None]:
    """Call a method of an object; yield before each statement of its own.

    What it calls runs as a part of the statement. So does all of a method without source, and of one that
    uses variables of a function around it, such as `super()`.
    """
    function = getattr(method, "__func__", None)
    lines = source_lines(method)
    if function is None or function.__closure__ or not lines:
        yield Stop(lines[0][0] if lines else 0)
        method(*arguments)
        return
    steps = _generator(function, lines)(method.__self__, *arguments)
    try:
        yield from itertools.starmap(Stop, steps)
    finally:
        _end(steps)


def _end(steps: Generator[Any, None, None]) -> None:
    """Leave a function in the middle: its `with` and `finally` still do what they have to."""
    with contextlib.suppress(Exception, GeneratorExit):
        steps.throw(GeneratorExit)
        for _ in steps:
            pass


def _generator(function: Any, lines: list[tuple[int, str]]) -> Callable[..., Generator[Any, None, None]]:
    """Return the function with a `yield` before each statement, of its line and locks."""
    tree = ast.parse("\n".join(text for _, text in lines))
    ast.increment_lineno(tree, lines[0][0] - 1)
    definition = tree.body[0]
    assert isinstance(definition, ast.FunctionDef)
    definition.decorator_list = []
    definition.body = list(_with_stops(definition.body))
    found: dict[str, Any] = {}
    code = compile(ast.fix_missing_locations(tree), function.__code__.co_filename, "exec")
    exec(code, function.__globals__, found)
    generator: Callable[..., Generator[Any, None, None]] = found[definition.name]
    generator.__defaults__, generator.__kwdefaults__ = function.__defaults__, function.__kwdefaults__
    return generator


def _with_stops(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements, each after a `yield`, except those that do nothing."""
    for statement in body:
        text = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
        if not text and not isinstance(statement, SILENT):
            yield _stop_before(statement)
        if not isinstance(statement, SILENT):
            for field in ("body", "orelse", "finalbody"):
                if inner := getattr(statement, field, None):
                    setattr(statement, field, list(_with_stops(inner)))
            for handler in getattr(statement, "handlers", ()):
                handler.body = list(_with_stops(handler.body))
        yield statement


def _stop_before(statement: ast.stmt) -> ast.stmt:
    managers = [item.context_expr for item in getattr(statement, "items", ())]
    match statement:
        case ast.Expr(ast.Call(ast.Attribute(lock, "acquire"), [], [])):
            managers.append(lock)
    locks: list[ast.expr] = [copy.deepcopy(each) for each in managers if _only_names(each)]
    values: list[ast.expr] = [ast.Constant(statement.lineno), ast.Tuple(locks, ast.Load())]
    return ast.copy_location(ast.Expr(ast.Yield(ast.Tuple(values, ast.Load()))), statement)


def _only_names(expression: ast.expr) -> bool:
    """Return whether an expression consists of names, so that looking at its value does nothing else."""
    while isinstance(expression, ast.Attribute):
        expression = expression.value
    return isinstance(expression, ast.Name)
