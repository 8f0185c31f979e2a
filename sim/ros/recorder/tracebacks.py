"""Which code is a student's own, and what an exception that left it looks like."""

from __future__ import annotations

import functools
import inspect
import linecache
import re
import sysconfig
import traceback
from types import CodeType, FrameType

from rclpy.node import Node

from sim.course_folders import COURSE, ROS_PACKAGES
from sim.evidence.rows import NOTE
from sim.notebook.none_origin import none_origin
from sim.suggestions import closest_match

# Code that is no student's: this package and tf2_ros, installed libraries, Python's own.
_OF_COURSE = (str(COURSE / "sim"), str(ROS_PACKAGES))
_CALLS = "callback", "_handler"  # attributes of timers and the like, and of tasks
_WRONG_CALL = re.compile(r"^(?:\S+\.)?([\w<>]+)\(\) (?:takes|missing) ")
_INTERFACE = re.compile(r"/(msg|srv|action)/_\w+\.py$")
SIMILAR = 0.8  # the least similarity of an attribute that was probably meant
_LIBRARIES = (*_OF_COURSE, *sysconfig.get_paths().values(), "<frozen ")


def is_library(filename: str) -> bool:
    """Return whether a source file is part of a library, this package or Python, and so not the student's."""
    return filename.startswith(_LIBRARIES) or (
        _INTERFACE.search(filename) is not None and _is_generated(filename)
    )


@functools.cache
def _is_generated(filename: str) -> bool:
    """Return whether it is the Python code of a message, service or action that rosidl generated."""
    return linecache.getline(filename, 1).startswith("# generated from rosidl_generator_py")


def is_of_course(filename: str) -> bool:
    """Return whether a source file is part of this package or of the ROS packages that it includes."""
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
    return own or _called_wrongly(error)


def _called_wrongly(error: BaseException) -> list[traceback.FrameSummary]:
    """Return where the student's function begins that a library called with other arguments than it takes."""
    at, found = error.__traceback__, _WRONG_CALL.search(text_of(error))
    if at is None or not isinstance(error, TypeError) or found is None:
        return []
    while at.tb_next is not None:
        at = at.tb_next
    values = [*at.tb_frame.f_locals.values()]
    values += [inspect.getattr_static(each, name, None) for each in values for name in _CALLS]
    for each in values:
        code = getattr(getattr(each, "__func__", each), "__code__", None)
        is_it = isinstance(code, CodeType) and code.co_qualname.endswith(found[1])
        if is_it and not is_library(code.co_filename):
            return [traceback.FrameSummary(code.co_filename, code.co_firstlineno, code.co_name)]
    return []


def is_raised_by_student(error: BaseException) -> bool:
    """Return whether the student's own code raises it, and not what that calls, or Ctrl-C."""
    stack = traceback.extract_tb(error.__traceback__)
    return bool(stack) and not is_library(stack[-1].filename)


def student_traceback(error: BaseException) -> str:
    """An exception's traceback, as Python prints it, with the student's frames only.

    If the exception is about a None whose origin is known, its last line says which function returned it.
    """
    origin = none_origin(error, is_library)
    lines = [*traceback.format_list(student_frames(error)), *traceback.format_exception_only(error)]
    return "".join([*lines, f"{NOTE}{origin}\n" if origin else ""])


def text_of(error: BaseException) -> str:
    """The text of an exception; of an unknown attribute with Python's question "Did you mean".

    Python's own question depends on its version, and names the node's lists, such as `publishers`, too.
    """
    try:
        near = _similar_attribute(error) if isinstance(error, AttributeError) else ""
        return f"{error}. Did you mean: {near!r}?" if near else str(error)
    except Exception:  # a student's class may raise here too
        return f"<{type(error).__name__} without text>"


def _similar_attribute(error: AttributeError) -> str:
    owner, kind = error.obj, type(error.obj)
    if owner is None or not error.name:
        return ""
    names = [name for name in dir(owner) if not name.startswith("_")]
    if isinstance(owner, Node):
        names = [name for name in names if not isinstance(getattr(kind, name, None), property)]
    return closest_match(error.name, names, SIMILAR)


def line_at(code: CodeType, instruction: int) -> int:
    """The line of the instruction at this offset of the code.

    Python's compiler gives some of a loop's jumps no line, and then a frame has none while a signal is
    handled there. Their line is that of the last instruction before them that has one.
    """
    lines = [line for begin, _, line in code.co_lines() if begin <= instruction and line is not None]
    return lines[-1] if lines else code.co_firstlineno


def student_line(frame: FrameType | None) -> str:
    """Return where in the student's own code a stack is, for the end of a sentence."""
    while frame is not None and is_library(frame.f_code.co_filename):
        frame = frame.f_back
    if frame is None:
        return ""
    line = frame.f_lineno or line_at(frame.f_code, frame.f_lasti)
    text = linecache.getline(frame.f_code.co_filename, line).strip()
    return f", at line {line}: {text}" if text else f", at line {line}"
