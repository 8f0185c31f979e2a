"""Formats an error for students: the lines of their own cells, and the error's message."""

from __future__ import annotations

import traceback
from collections.abc import Iterator, Mapping
from typing import Any

LINES = 8  # of the student's own that are shown: the last ones
ERRORS = 3  # of a chain of causes that are shown
TEXT = 4_000  # characters of a message


def error_output(error: BaseException, cells: Mapping[str, int]) -> dict[str, Any]:
    """An output of nbformat 4. cells: the number of the cell by the file name of its code.

    Frames of libraries and of the course are left out: the mistake is not there, and paths show this machine.
    """
    summary = traceback.TracebackException.from_exception(error, compact=True)
    lines = list(_format_chain(summary, cells, ERRORS))
    return {"output_type": "error", "ename": type(error).__name__, "evalue": _text(error), "traceback": lines}


def _format_chain(
    summary: traceback.TracebackException, cells: Mapping[str, int], most: int
) -> Iterator[str]:
    before = summary.__cause__ or (None if summary.__suppress_context__ else summary.__context__)
    if before is not None and most > 1:
        yield from _format_chain(before, cells, most - 1)
        yield "The next error was caused by this one, or came while handling it:"
    own = [frame for frame in summary.stack if frame.filename in cells]
    if len(own) > LINES:
        yield f"... {len(own) - LINES} more lines"
    for frame in own[-LINES:]:
        within = "" if frame.name.startswith("<module>") else f", in {frame.name}"
        yield f"In [{cells[frame.filename]}], line {frame.lineno}{within}:"
        yield f"    {frame.line}"
    if getattr(summary, "filename", None) in cells:  # a SyntaxError has no frame of its own
        summary.filename = f"In [{cells[summary.filename]}]"
    for line in summary.format_exception_only():
        yield line.rstrip("\n")[:TEXT]


def _text(error: BaseException) -> str:
    try:
        return str(error)[:TEXT]
    except Exception:  # a student's own exception class may raise in __str__
        return "its text can't be read"
