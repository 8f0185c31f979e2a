"""Where the entities of a launch file are: dictionaries and actions that know their file and line."""

from __future__ import annotations

import sys

ERRORS = (AttributeError, RuntimeError, TypeError, ValueError)
PYTHON_FILE = "python_launch_file"  # the name of the module that a launch file in Python becomes
MAX_DEPTH = 8  # constructors of subclasses between a launch file and `Action`


class Located(dict):
    """A dictionary of a launch file. place: "FILE, line N"."""

    place = ""


def add_place(error: Exception, place: str | None) -> None:
    """Append the place of an entity to the text of an error, unless a place is in it already."""
    if place and not getattr(error, "place", ""):
        error.place = place
        text, *_ = (*error.args, error)  # not str(error): a KeyError quotes its text
        error.args = (f"{text} ({place})",)


def place_in_python() -> str | None:
    """The line of the launch file in Python that is being executed; None outside of one."""
    frame = sys._getframe(2)
    for _ in range(MAX_DEPTH):
        if frame is None:
            return None
        if frame.f_globals.get("__name__") == PYTHON_FILE:
            return f"{frame.f_code.co_filename}, line {frame.f_lineno}"
        frame = frame.f_back
    return None
