"""Exceptions that a callback raises on purpose, for the function that spins to catch: they end `spin()`."""

from __future__ import annotations

import ast
import functools
import inspect
import linecache
import re
import textwrap
from collections.abc import Iterator
from types import CodeType, FrameType

from sim.ros.recorder.tracebacks import is_library

_ALL = (object, BaseException, Exception)  # to catch one of these is no sign of a purpose


def is_expected(error: BaseException, *stacks: FrameType | None) -> bool:
    """Return whether the student's code raises it by `raise`, and a function on one of these stacks names it.

    That function has it, or a class between it and Exception, in an `except` or a `suppress`.
    """
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    if last is None or is_library(last.tb_frame.f_code.co_filename):
        return False
    if not re.search(r"\braise\b", linecache.getline(last.tb_frame.f_code.co_filename, last.tb_lineno)):
        return False
    names = {class_.__name__ for class_ in type(error).__mro__ if class_ not in _ALL}
    return any(
        frame.f_lineno in lines and names & caught
        for stack in stacks
        for frame in _own_frames(stack)
        for lines, caught in _catching(frame.f_code)
    )


def _own_frames(frame: FrameType | None) -> Iterator[FrameType]:
    """The student's functions on a stack."""
    while frame is not None:
        if not is_library(frame.f_code.co_filename):
            yield frame
        frame = frame.f_back


@functools.lru_cache(maxsize=100)
def _catching(code: CodeType) -> list[tuple[range, frozenset[str]]]:
    """The lines of a function that are in a `try` or a `suppress`, with the names of what that catches."""
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(code)))
    except (OSError, SyntaxError, TypeError):
        return []
    ast.increment_lineno(tree, code.co_firstlineno - 1)
    found = []
    for part in ast.walk(tree):
        caught: list[ast.expr | None] = []
        if isinstance(part, ast.Try):
            caught = [handler.type for handler in part.handlers]
        elif isinstance(part, ast.With):
            calls = [each.context_expr for each in part.items if isinstance(each.context_expr, ast.Call)]
            caught = [
                name for call in calls if ast.unparse(call.func).endswith("suppress") for name in call.args
            ]
        inner = [
            each for part_ in caught for each in (part_.elts if isinstance(part_, ast.Tuple) else [part_])
        ]
        if inner:
            lines = range(part.body[0].lineno, (part.body[-1].end_lineno or 0) + 1)  # type: ignore[attr-defined]
            found.append((lines, frozenset(ast.unparse(each).rpartition(".")[2] for each in inner if each)))
    return found
