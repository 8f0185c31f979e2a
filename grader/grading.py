"""How the process that calls `Exercise.grade` grades: a test cell's one line names nothing but nodes.

A student's notebook judges the nodes itself, on public seeds. A kernel of nbgrader's does so with a student's
share of the secret. The student's process of `python -m grader mark` hands the nodes over to its judge.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

VARIABLE = "COURSE_SECRET"  # the environment of the kernels in which nbgrader marks; set by marking/secret.py


@dataclass(frozen=True)
class Grading:
    """The way a process grades.

    secret: worlds and seeds are derived from it; "" for the public ones. hand_over: called with the name of
    the exercise and the nodes in place of judging them here.
    """

    secret: str = ""
    hand_over: Callable[[str, Sequence[Any]], Any] | None = None


def current_grading() -> Grading:
    """The one that `graded_as` set; otherwise judging here, with the secret of this process's environment."""
    return _current.get() or Grading(os.environ.get(VARIABLE, ""))


@contextlib.contextmanager
def graded_as(grading: Grading) -> Iterator[None]:
    """Set how code is graded that runs inside, and in tasks that are created inside."""
    token = _current.set(grading)
    try:
        yield
    finally:
        _current.reset(token)


_current: ContextVar[Grading | None] = ContextVar("grading", default=None)
