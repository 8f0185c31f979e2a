"""Classroom 50: result.json of an autograder.py.

The form is `classroom50/result/v1` of https://github.com/foundation50/classroom50. Its points are integers,
so a score counts half points.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

from grader.marking.extras.platforms.texts import MARKS, check_text, overview

SCHEMA = "classroom50/result/v1"
HALVES = 2
STAMPED = {  # what the runner passes, and the field that it is for
    "CLASSROOM": "classroom",
    "ASSIGNMENT": "assignment",
    "SUBMISSION_TAG": "submission",
    "COMMIT_URL": "commit",
    "RELEASE_URL": "release",
}


def result(
    data: dict[str, Any], environment: Mapping[str, str], now: datetime | None = None
) -> dict[str, Any]:
    """The content of result.json. data: a report of mark-one. environment: that of the runner."""
    tests = [_row(exercise) for exercise in data["exercises"]]
    stamped = {field: environment.get(name, "") for name, field in STAMPED.items()}
    return {
        "schema": SCHEMA,
        **stamped,
        "assignment_type": environment.get("ASSIGNMENT_TYPE") or "individual",
        "owner": environment.get("OWNER") or environment.get("USERNAME", ""),
        "review": environment.get("REVIEW_URL") or stamped["commit"],
        "datetime": f"{now or datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ}",
        "score": sum(test["score"] for test in tests),
        "max-score": sum(test["max-score"] for test in tests) or halves(data["max_points"]),
        "tests": tests,
    }


def _row(exercise: Mapping[str, Any]) -> dict[str, Any]:
    score, most = halves(exercise["points"]), halves(exercise["max_points"])
    return {
        "test-name": exercise["exercise"],
        "passed": score == most,
        "score": score,
        "max-score": most,
        "output": "\n".join(map(check_text, exercise["checks"])).strip(),
    }


def halves(points: float) -> int:
    """Points as a number of half points, rounded down."""
    return math.floor(points * HALVES + 1e-6)


def release_body(data: dict[str, Any]) -> str:
    """The text of the release that the runner publishes, as Markdown."""
    lines = [f"### {data['assignment']}: {data['points']:g} of {data['max_points']:g} points", ""]
    lines += [_plain(overview(data)), "", "| check | points | |", "|--|--|--|"]
    for exercise in data["exercises"]:
        for check in exercise["checks"]:
            points = f"{check['points']:g} of {check['max_points']:g}"
            words = f"{MARKS[check['status']]}. {check_text(check)}".strip()
            name = f"{exercise['exercise']}: {check['sentence']}"
            lines.append(f"| {_cell(name)} | {points} | {_cell(words)} |")
    return "\n".join(lines) + "\n"


def _plain(text: str) -> str:
    """Text in which nothing of the student's is Markdown or HTML."""
    return "".join(f"\\{letter}" if letter in "\\`*_[]<>#|!" else letter for letter in text)


def _cell(text: str) -> str:
    return "<br>".join(_plain(text).splitlines())
