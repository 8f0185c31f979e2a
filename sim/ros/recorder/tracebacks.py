"""Which code is a student's own, and what an exception that left it looks like."""

from __future__ import annotations

import linecache
import sysconfig
import traceback
from pathlib import Path
from types import FrameType

_COURSE = Path(__file__).parents[3]
# Code that is no student's: this package and tf2_ros, installed libraries, Python's own.
_OF_COURSE = (str(_COURSE / "sim"), str(_COURSE / "ros_packages"))
_LIBRARIES = (*_OF_COURSE, *sysconfig.get_paths().values(), "<frozen ")


def is_library(filename: str) -> bool:
    """Whether a source file is part of a library, this package or Python, and so not the student's."""
    return filename.startswith(_LIBRARIES)


def student_frames(error: BaseException) -> list[traceback.FrameSummary]:
    """The frames of an exception that are the student's own."""
    frames = traceback.extract_tb(error.__traceback__)
    return [frame for frame in frames if not is_library(frame.filename)]


def student_traceback(error: BaseException) -> str:
    """An exception's traceback, as Python prints it, with the student's frames only."""
    return "".join(traceback.format_list(student_frames(error)) + traceback.format_exception_only(error))


def text_of(error: BaseException) -> str:
    """The text of an exception."""
    try:
        return str(error)
    except Exception:  # a student's class may raise here too
        return f"<{type(error).__name__} without text>"


def student_line(frame: FrameType | None) -> str:
    """Where in the student's own code a stack is, for the end of a sentence."""
    while frame is not None and is_library(frame.f_code.co_filename):
        frame = frame.f_back
    if frame is None:
        return ""
    text = linecache.getline(frame.f_code.co_filename, frame.f_lineno).strip()
    return f", at line {frame.f_lineno}: {text}" if text else f", at line {frame.f_lineno}"
