"""Which code is a student's own, and what an exception that left it looks like."""

from __future__ import annotations

import linecache
import sysconfig
import traceback
from types import CodeType, FrameType

from sim.course_folders import COURSE, ROS_PACKAGES

# Code that is no student's: this package and tf2_ros, installed libraries, Python's own.
_OF_COURSE = (str(COURSE / "sim"), str(ROS_PACKAGES))
_LIBRARIES = (*_OF_COURSE, *sysconfig.get_paths().values(), "<frozen ")


def is_library(filename: str) -> bool:
    """Whether a source file is part of a library, this package or Python, and so not the student's."""
    return filename.startswith(_LIBRARIES)


def is_of_course(filename: str) -> bool:
    """Whether a source file is part of this package or of the ROS packages that it includes."""
    return filename.startswith(_OF_COURSE)


def student_frames(error: BaseException) -> list[traceback.FrameSummary]:
    """The frames of an exception that are the student's own."""
    own = []
    at = error.__traceback__
    for frame in traceback.extract_tb(error.__traceback__):
        if not is_library(frame.filename):
            line = frame.lineno or line_at(at.tb_frame.f_code, at.tb_lasti)
            own.append(frame if frame.lineno else traceback.FrameSummary(frame.filename, line, frame.name))
        at = at.tb_next
    return own


def student_traceback(error: BaseException) -> str:
    """An exception's traceback, as Python prints it, with the student's frames only."""
    return "".join(traceback.format_list(student_frames(error)) + traceback.format_exception_only(error))


def text_of(error: BaseException) -> str:
    """The text of an exception."""
    try:
        return str(error)
    except Exception:  # a student's class may raise here too
        return f"<{type(error).__name__} without text>"


def line_at(code: CodeType, instruction: int) -> int:
    """The line of the instruction at this offset of the code.

    Python's compiler gives some of a loop's jumps no line, and then a frame has none while a signal is
    handled there. Their line is that of the last instruction before them that has one.
    """
    lines = [line for begin, _, line in code.co_lines() if begin <= instruction and line is not None]
    return lines[-1] if lines else code.co_firstlineno


def student_line(frame: FrameType | None) -> str:
    """Where in the student's own code a stack is, for the end of a sentence."""
    while frame is not None and is_library(frame.f_code.co_filename):
        frame = frame.f_back
    if frame is None:
        return ""
    line = frame.f_lineno or line_at(frame.f_code, frame.f_lasti)
    text = linecache.getline(frame.f_code.co_filename, line).strip()
    return f", at line {line}: {text}" if text else f", at line {line}"
