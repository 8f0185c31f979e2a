"""Angles made by `numpy.arange` up to angle_max: one fewer than the rays of the scan, or one more."""

from __future__ import annotations

import ast
import re

import numpy as np

from grader.diagnosis.rays import last_scan
from grader.diagnosis.student_nodes import node_classes
from sim.evidence import CallbackError, Recording, frames_of
from sim.notebook.class_source import function_tree, methods_of
from sim.notebook.run_programs import run_programs

_KINDS = ("IndexError", "TypeError", "ValueError")
_LENGTHS = (
    r"list index out of range|same (shape|length)|shapes of a and weights|argument \d is (short|long)er"
)


def angles_of_arange(error: CallbackError, recording: Recording) -> str:
    """Two lengths that differ: a scan's and that of its angles; "" for other errors."""
    scan = last_scan(recording, error.node, error.stamp) if error.type in _KINDS else None
    if scan is None:
        return ""
    rays, step = len(scan.message.ranges), scan.message.angle_increment
    angles = len(np.arange(scan.message.angle_min, scan.message.angle_max, step)) if step else rays
    makers = _makers(recording)
    if not re.search(rf"\b{angles}\b", error.text):  # without numbers it could be about something else
        makers &= {frame[2] for frame in frames_of(error)} if re.search(_LENGTHS, error.text) else set()
    if angles == rays or not makers:
        return ""
    return (
        f"The scan has {rays} ranges, but np.arange(angle_min, angle_max, angle_increment) gives {angles} "
        "angles: it leaves out its end. Count the rays instead: "
        "`angles = msg.angle_min + np.arange(len(msg.ranges)) * msg.angle_increment`."
    )


def _makers(recording: Recording) -> set[str]:
    """The student's methods and functions that call `np.arange(..., msg.angle_max, ...)`."""
    trees = [tree for class_ in node_classes(recording) for tree in methods_of(class_).values()]
    trees += filter(None, map(function_tree, run_programs(recording)))
    return {
        tree.name
        for tree in trees
        for part in ast.walk(tree)
        if isinstance(part, ast.Call)
        and getattr(part.func, "attr", getattr(part.func, "id", "")) == "arange"
        and any(getattr(value, "attr", "") == "angle_max" for value in part.args)
    }
