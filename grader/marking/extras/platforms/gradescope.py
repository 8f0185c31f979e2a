"""Gradescope: results.json from a report, and what submission_metadata.json says of a submission.

The forms are those of https://gradescope-autograders.readthedocs.io/en/latest/specs/.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from grader.marking.errors import CourseError
from grader.marking.extras.platforms.texts import check_html, overview_html

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


def results(
    data: dict[str, Any], visibility: str = "visible", leaderboard: Sequence[Mapping[str, Any]] = ()
) -> dict[str, Any]:
    """The content of results.json. data: a report of mark-one. visibility: of each test.

    leaderboard: its columns, if the robot worked in the league's warehouses. There is no hidden test, because
    students would not see their total. What is for the instructor is printed; see `instructor_text`.
    """
    return {
        "score": data["points_after_lateness"],
        "execution_time": round(data["seconds"]),
        "output": overview_html(data),
        "output_format": "html",
        "visibility": visibility,
        "stdout_visibility": "hidden",
        "tests": [
            _test(f"{number}.{part}", exercise["exercise"], check, visibility)
            for number, exercise in enumerate(data["exercises"], 1)
            for part, check in enumerate(exercise["checks"], 1)
        ],
        **({"leaderboard": list(leaderboard)} if leaderboard else {}),
        "extra_data": {"verdict": data["verdict"], "isolation": data["isolation"]},
    }


def _test(number: str, exercise: str, check: Mapping[str, Any], visibility: str) -> dict[str, Any]:
    return {
        "number": number,
        "name": f"{exercise}: {check['sentence']}",
        "score": check["points"],
        "max_score": check["max_points"],
        **({"status": STATUS[check["status"]]} if check["status"] in STATUS else {}),
        "output": check_html(check),
        "output_format": "html",
        "visibility": visibility,
    }
