"""Exceptions that a callback raises on purpose, for the function that spins to catch: they end `spin()`."""

from __future__ import annotations

import ast
import functools
import inspect
import linecache
import sys
import textwrap
from types import CodeType

from sim.ros.recorder.tracebacks import is_library

_ALL = (object, BaseException, Exception)  # to catch one of these is no sign of a purpose


def is_expected(error: BaseException) -> bool:
    """Whether the student's code raises it by `raise`, and a function further down the stack names it.

    That function has it, or a class between it and Exception, in an `except` or a `suppress`.
    """
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    if last is None or is_library(last.tb_frame.f_code.co_filename):
        return False
    line = linecache.getline(last.tb_frame.f_code.co_filename, last.tb_lineno)
    if not line.lstrip().startswith("raise "):
        return False
    names = {class_.__name__ for class_ in type(error).__mro__ if class_ not in _ALL}
    frame = sys._getframe(1)
    while frame is not None:
        code = frame.f_code
        if not is_library(code.co_filename) and names & _caught_in(code):
            return True
        frame = frame.f_back
    return False


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
