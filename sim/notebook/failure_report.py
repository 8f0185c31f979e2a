"""Shows at the end of a run why it failed: in a notebook below the cell, in a terminal on stderr."""

from __future__ import annotations

import html
import logging
import re
import sys
import weakref
from collections.abc import Callable
from importlib.metadata import entry_points
from typing import Any

from sim.evidence import Recording, first_error, frames_of
from sim.notebook.kernel import shell

# Entry points of this group explain a failure; each takes a recording and returns lines of text.
GROUP = "sim.failure_explainers"
# Dark red on light red: 8 to 1, in a light and in a dark page.
STYLE = "color: #8c1d18; background-color: #fdecea; padding: 6px 10px; margin: 4px 0"
_CODE = re.compile("`([^`]+)`")
# The page's own colors of code are legible on its own background only.
_AS_CODE = r'<code style="color: inherit; background: none">\1</code>'
_RED, _PLAIN = "\x1b[31m", "\x1b[0m"
_reported: tuple[int, weakref.ref[Recording]] | None = None  # the execution count, and what was shown in it


def report_failure(recording: Recording) -> None:
    """Show the first error in the user's programs, or why they got stuck, with a hint; else nothing.

    Outside a notebook and a terminal nothing is shown: a program reads `Recording.failure`.
    """
    global _reported
    lines = failure_lines(recording)
    if not lines:
        return
    ipython = shell()
    if ipython is not None:
        _reported = (ipython.execution_count, weakref.ref(recording))
        ipython.display_pub.publish({"text/html": failure_html(lines), "text/plain": "\n".join(lines)})
    elif sys.stderr.isatty():
        print(_RED + "\n".join(lines) + _PLAIN, file=sys.stderr)


def is_reported(recording: Recording) -> bool:
    """Return whether the running cell has already shown the failure of this recording."""
    ipython = shell()
    if ipython is None or _reported is None:
        return False
    count, reference = _reported
    return count == ipython.execution_count and reference() is recording


def failure_lines(recording: Recording) -> list[str]:
    """The failure of a run, then the hint, each in a line; empty if it did not fail."""
    if not recording.failure:
        return []
    for explain in _explainers():
        lines = explain(recording)
        if lines:
            return [name_cell(line, recording) for line in lines]
    return [name_cell(recording.failure, recording)]


def failure_html(lines: list[str]) -> str:
    """The lines in red, legible without a style sheet."""
    if not lines:
        return ""
    first, *more = (_CODE.sub(_AS_CODE, html.escape(line)) for line in lines)
    text = "<br>".join([f"<strong>{first}</strong>", *more])
    return f'<div class="ros2-failure" style="{STYLE}">{text}</div>'


def name_cell(text: str, recording: Recording) -> str:
    """Add the notebook cell of the first error to the line number in the text, as in "cell [3], line 7"."""
    error = first_error(recording)
    frames = frames_of(error) if error is not None else []
    cell = _cell_number(frames[-1][0]) if frames else ""
    if not cell:
        return text
    line = f"line {frames[-1][1]}"
    return re.sub(rf", {line}, at ", f", cell [{cell}], {line}, at ", text)


def _cell_number(filename: str) -> str:
    """The execution count of the cell that was compiled as this file; "" for other files."""
    name_of = getattr(getattr(shell(), "compile", None), "format_code_name", None)
    named = name_of(filename) if name_of is not None else None
    found = re.fullmatch(r"In\[(\d+)\]", named[1]) if named else None
    return found[1] if found else ""


def _explainers() -> list[Callable[[Recording], list[str]]]:
    found: list[Any] = []
    for entry in entry_points(group=GROUP):
        try:
            found.append(entry.load())
        except ImportError as error:  # an explainer is optional: the error itself is always shown
            logging.getLogger(__name__).warning("%s can't be loaded: %s", entry.value, error)
    return found
