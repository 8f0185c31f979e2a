"""PrairieLearn: results.json of an external grader, and a question's info.json.

The forms are those of https://prairielearn.readthedocs.io/en/latest/externalGrading/.
"""

from __future__ import annotations

from typing import Any

from grader.marking.extras.platforms.texts import check_text, overview

MAX_KB = 900  # PrairieLearn takes 1 MB


def results(data: dict[str, Any]) -> dict[str, Any]:
    """The content of results.json. data: a report of mark-one. The score is between 0 and 1."""
    if data["verdict"] == "refused":
        return {"gradable": False, "format_errors": [data["reason"]]}
    most = data["max_points"]
    return {
        "gradable": True,
        "score": min(1.0, data["points"] / most) if most else 0.0,
        "message": overview(data),
        "tests": [
            {
                "name": f"{exercise['exercise']}: {check['sentence']}",
                "points": check["points"],
                "max_points": check["max_points"],
                "message": check_text(check),
            }
            for exercise in data["exercises"]
            for check in exercise["checks"]
        ],
    }


def student_of(data: dict[str, Any]) -> str:
    """A name on which the worlds depend: of /grade/data/data.json, the variant's seed."""
    return f"variant {data.get('variant_seed', '')}"


def info(image: str, seconds: float) -> dict[str, Any]:
    """The part of a question's info.json that calls the grader."""
    options = {"enabled": True, "image": image, "timeout": min(600, round(seconds) + 60)}
    return {"gradingMethod": "External", "externalGradingOptions": options}
