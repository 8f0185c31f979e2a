"""An error as a student reads it: the lines of their own cells, and what went wrong there."""

from __future__ import annotations

import traceback
from collections.abc import Iterator, Mapping
from typing import Any

LINES = 8  # of the student's own are shown, the last ones
ERRORS = 3  # that led to one another
TEXT = 4_000  # characters of a message


def error_output(error: BaseException, cells: Mapping[str, int]) -> dict[str, Any]:
    """An output of nbformat 4. cells: the number of the cell by the file name of its code.

    Frames of libraries and of the course are left out: they are nobody's mistake, and tell of this machine.
    """
    told = traceback.TracebackException.from_exception(error, compact=True)
    lines = list(_chain(told, cells, ERRORS))
    return {
        "output_type": "error",
        "ename": type(error).__name__,
        "evalue": _text(error),
        "traceback": lines,
    }


def _chain(told: traceback.TracebackException, cells: Mapping[str, int], most: int) -> Iterator[str]:
    before = told.__cause__ or (None if told.__suppress_context__ else told.__context__)
    if before is not None and most > 1:
        yield from _chain(before, cells, most - 1)
        yield "This led to, or came while dealing with it:"
    own = [frame for frame in told.stack if frame.filename in cells]
    if len(own) > LINES:
        yield f"... {len(own) - LINES} more lines"
    for frame in own[-LINES:]:
        within = "" if frame.name.startswith("<module>") else f", in {frame.name}"
        yield f"In [{cells[frame.filename]}], line {frame.lineno}{within}:"
        yield f"    {frame.line}"
    if getattr(told, "filename", None) in cells:  # a SyntaxError has no frame of its own
        told.filename = f"In [{cells[told.filename]}]"
    for line in told.format_exception_only():
        yield line.rstrip("\n")[:TEXT]


def _text(error: BaseException) -> str:
    try:
        return str(error)[:TEXT]
    except Exception:  # a student's own class of errors may fail at that, too
        return "its text can't be read"
