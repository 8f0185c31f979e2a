"""Test cells of plain Python, such as `assert double(3) == 6`: they run in the student's process.

What that process reports decides the points of the cell, as with nbgrader itself: a student's program could
change what the test calls. It reaches nothing else, and no other cell's points.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from grader.marking.result import CellResult

MAX_TEXT = 500  # characters of an error


@dataclass(frozen=True)
class PlainTest:
    """A test cell without an exercise of the course. name: its grade_id."""

    name: str


def read_points(name: str, worth: float, outputs: Sequence[dict[str, Any]]) -> tuple[CellResult, str]:
    """The result of a plain test by its outputs, and a problem for the instructor, or "".

    An error gives no points; a number in the last line gives so many; no value gives all.
    """
    errors = [each for each in outputs if each["output_type"] == "error"]
    values = [each for each in outputs if each["output_type"] == "execute_result"]
    problem = ""
    if errors:
        points, saw = 0.0, f"{errors[0]['ename']}: {errors[0]['evalue']}"
        saw = errors[0]["evalue"] if errors[0]["ename"] == "AssertionError" and errors[0]["evalue"] else saw
    elif values:
        text = str(values[0]["data"].get("text/plain", ""))
        points = _number(text)
        saw = f"{points:g} of {worth:g} points"
        if not 0 <= points <= worth:
            problem = f"its last line gives {text[:50]!r}; expected a number of points from 0 to {worth:g}"
            points, saw = 0.0, "no number of points"
    else:
        points, saw = worth, ""
    verdict = _verdict(name, points, worth, saw[:MAX_TEXT])
    return CellResult(name, name, points, worth, [verdict], needs_look=bool(problem)), problem


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _verdict(name: str, points: float, worth: float, saw: str) -> dict[str, Any]:
    passed = points == worth
    return {
        "name": name,
        "sentence": "The test cell ends without an error and with all points.",
        "points": worth,
        "credit": points / worth if worth else 1.0,
        "earned": points,
        "status": "passed" if passed else "failed",
        **{"expected": "", "saw": "" if passed else saw, "hint": "", "picture": "", "alarm": "", "run": 0},
    }
