"""The first failure of a run in one sentence: what left a callback, or why the run could not continue."""

from __future__ import annotations

import itertools
import re

from sim.evidence.rows import CallbackError
from sim.evidence.run_data import RunData

UNREADABLE = ("IndentationError", "SyntaxError", "TabError")
STUCK = ("hang", "livelock", "blocked")  # reasons of an end that the programs are to blame for
# Classes of ROS that call a student's method inside a callback of their own.
_CALLERS = ("ActionClient.", "ActionServer.", "ParameterService.", "Subscriber.")


def first_error(data: RunData) -> CallbackError | None:
    """The first error in a program of the user, if there is one."""
    return next((error for error in data.errors if error not in data.course_errors), None)


def failure_of(data: RunData) -> str:
    """The first error in the user's programs with its place, or why the run got stuck; "" without either."""
    error = first_error(data)
    if error is not None:
        return f"{error.type}: {first_line(error.text, error.type)} ({place_of(error)})"
    return data.ended.detail if data.ended.reason in STUCK else ""


def first_line(text: str, kind: str) -> str:
    """The first line of an error's text.

    It is without the place that a syntax error repeats in it, and without the file of the module that an
    ImportError names: a path of the machine that ran it.
    """
    if kind in UNREADABLE:
        text = re.sub(r" \([^()]+, line \d+\)$", "", text)
    if kind == "ImportError":
        text = re.sub(r" \((?:[^()]*/[^()]*|unknown location)\)$", "", text)
    text = re.sub(r"-?\d{20,}(\.\d+)?", lambda number: f"{float(number[0]):.4g}", text)  # limits of a double
    return text.strip().split("\n")[0] or "no message"


def place_of(error: CallbackError) -> str:
    """The place of an error: "in Talker.tick, line 12, at 0.5 s".

    For code that Python could not parse it is the line of the syntax error, not the import.
    """
    unread = re.search(r"\(([^()]+), line (\d+)\)$", error.text) if error.type in UNREADABLE else None
    if unread:
        return f"in {unread[1]}, line {unread[2]}, at {error.stamp:.3g} s"
    own = frames_of(error)
    callback = error.callback or "a callback"
    if own and callback.startswith(_CALLERS):
        callback = own[0][2]
    line = f", line {own[-1][1]}" if own else ""
    return f"in {callback}{line}, at {error.stamp:.3g} s"


def last_line(error: CallbackError) -> str:
    """The line of the user's code in which the error came up; "" where a library called what failed."""
    lines = [line.strip() for line in error.traceback.splitlines()]
    own = [after for line, after in itertools.pairwise(lines) if line.startswith("File ")]
    return own[-1] if own else ""


def frames_of(error: CallbackError) -> list[tuple[str, str, str]]:
    """File, line and function of each of the user's frames in the traceback, the innermost last."""
    return re.findall(r'File "(.*?)", line (\d+), in (.+)', error.traceback)
