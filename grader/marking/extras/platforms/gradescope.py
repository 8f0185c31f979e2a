"""Gradescope: results.json from a report, and what submission_metadata.json says of a submission.

The forms are those of https://gradescope-autograders.readthedocs.io/en/latest/specs/.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.marking.errors import CourseError
from grader.marking.extras.platforms.texts import check_text, instructor_text, overview

VISIBILITIES = ("visible", "after_due_date", "after_published", "hidden")
STATUS = {"passed": "passed", "failed": "failed"}


@dataclass(frozen=True)
class SubmissionMetadata:
    """The student and the times of a submission. student: the first user's mail, in alphabetical order.

    due, handed_in: with an offset, as Gradescope writes them; "" if there is no due date. An extension of
    the student's counts.
    """

    student: str
    handed_in: str
    due: str = ""


def read_metadata(path: Path) -> SubmissionMetadata:
    """Read submission_metadata.json. Raises CourseError if it doesn't say who submitted."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        users = sorted(data["users"], key=lambda user: str(user["email"]))
        due = (users[0].get("assignment") or {}).get("due_date") or data["assignment"].get("due_date")
        return SubmissionMetadata(str(users[0]["email"]), str(data["created_at"]), str(due or ""))
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        raise CourseError(f"{path} does not say who submitted ({type(error).__name__}: {error})") from None


def results(data: dict[str, Any], visibility: str = "visible") -> dict[str, Any]:
    """The content of results.json. data: a report of mark-one. visibility: of each test."""
    tests = [
        {
            "number": f"{number}.{part}",
            "name": f"{exercise['exercise']}: {check['sentence']}",
            "score": check["points"],
            "max_score": check["max_points"],
            **({"status": STATUS[check["status"]]} if check["status"] in STATUS else {}),
            "output": check_text(check),
            "output_format": "text",
            "visibility": visibility,
        }
        for number, exercise in enumerate(data["exercises"], 1)
        for part, check in enumerate(exercise["checks"], 1)
    ]
    hidden = {"name": "For the instructor", "number": "0", "score": 0, "max_score": 0, "visibility": "hidden"}
    return {
        "score": data["points_after_lateness"],
        "execution_time": round(data["seconds"]),
        "output": overview(data),
        "output_format": "text",
        "visibility": visibility,
        "stdout_visibility": "hidden",
        "tests": [*tests, {**hidden, "output": instructor_text(data), "output_format": "text"}],
        "extra_data": {"verdict": data["verdict"], "isolation": data["isolation"]},
    }
