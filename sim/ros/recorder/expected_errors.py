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
    """Whether the student's code raises it by `raise`, and a function on one of these stacks names it.

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
    return any(names & _caught_in(code) for frame in stacks for code in _own_code(frame))


def _own_code(frame: FrameType | None) -> Iterator[CodeType]:
    """The student's functions on a stack."""
    while frame is not None:
        if not is_library(frame.f_code.co_filename):
            yield frame.f_code
        frame = frame.f_back


@functools.lru_cache(maxsize=100)
def _caught_in(code: CodeType) -> frozenset[str]:
    """The names of the exceptions that a function catches; none without its source."""
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(code)))
    except (OSError, SyntaxError, TypeError):
        return frozenset()
    caught: list[ast.expr] = []
    for part in ast.walk(tree):
        if isinstance(part, ast.ExceptHandler) and part.type is not None:
            caught.append(part.type)
        elif isinstance(part, ast.Call) and ast.unparse(part.func).endswith("suppress"):
            caught += part.args
    inner = [each for part in caught for each in (part.elts if isinstance(part, ast.Tuple) else [part])]
    return frozenset(ast.unparse(each).rpartition(".")[2] for each in inner)
