"""The result of one submission as JSON, in the form of result.schema.json."""
from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC
from pathlib import Path
from typing import Any

from grader.marking.extras.one_submission.judge_one import Judged
from grader.marking.judge.marking_state import cell_name
from grader.marking.judge.testcells import is_test
from grader.marking.lateness import DAY_S, Lateness, late_penalty
from grader.marking.outputs import writable_text
from grader.marking.result import CellResult, Result
from grader.marking.submission.assignment_release import Release

FORM = "ros2-notebook-course/mark-one/1"
SCHEMA = Path(__file__).with_name("result.schema.json")
CHECK_TEXTS = ("sentence", "expected", "saw", "hint")
SHORTER = (math.inf, 5000, 1000, 300, 100, 30)  # characters of one text, tried one after the other


@dataclass(frozen=True)
class LateRule:
    """The times of a submission, and the percent of its points that a late day costs."""

    lateness: Lateness
    percent_per_day: float = 0.0

    def penalty(self, result: Result) -> float:
        """The points that are lost, of each notebook as nbgrader computes them."""
        if not (self.percent_per_day and self.lateness.seconds):
            return 0.0
        earned = [math.fsum(cell.points for cell in note.cells) for note in result.notebooks]
        late = self.lateness.seconds
        return math.fsum(late_penalty(points, late, self.percent_per_day) for points in earned)

    def as_dict(self, result: Result) -> dict[str, Any]:
        """Return it as JSON data. Times are UTC."""
        about = self.lateness
        return {
            "due": about.due.replace(tzinfo=UTC).isoformat(),
            "handed_in": about.handed_in.replace(tzinfo=UTC).isoformat(),
            "days": about.seconds / DAY_S,
            "percent_per_day": self.percent_per_day,
            "penalty": self.penalty(result),
        }


def report(judged: Judged, late: LateRule | None = None) -> dict[str, Any]:
    """The result as JSON data: what students may read, and `flags`, `evidence`, which are not for them."""
    result = judged.result
    exercises = list(_exercises(result))
    penalty = late.penalty(result) if late else 0.0
    return {
        "form": FORM,
        "student": result.student,
        "assignment": result.assignment,
        "verdict": result.verdict,
        "reason": result.reason,
        "points": result.points,
        "max_points": _most(judged.release, result),
        "points_after_lateness": max(0.0, result.points - penalty),
        "late": late.as_dict(result) if late else None,
        "repairs": list(result.repairs),
        "flags": list(result.flags),
        "exercises": exercises,
        "needs_look": any(each["needs_look"] for each in exercises),
        "points_by_hand": _by_hand(judged.release),
        "isolation": judged.isolation,
        "evidence": judged.evidence,
        "seconds": round(result.timings.get("total", 0.0), 3),
    }


def as_text(data: dict[str, Any], most_bytes: float = math.inf) -> str:
    """The report as JSON text; long texts in it are shortened until it has at most `most_bytes` bytes."""
    for length in SHORTER:
        text = json.dumps(_shortened(data, length), indent=1, ensure_ascii=False, allow_nan=False) + "\n"
        text = writable_text(text)
        if len(text.encode()) <= most_bytes:
            break
    return text


def _exercises(result: Result) -> Iterator[dict[str, Any]]:
    for note in result.notebooks:
        for cell in note.cells:
            yield {
                "exercise": cell.exercise,
                "notebook": note.name,
                "cell": cell.cell,
                "points": cell.points,
                "max_points": cell.max,
                "unsafe": any(verdict.get("unsafe") for verdict in cell.verdicts),
                "needs_look": cell.needs_look,
                "checks": list(_checks(cell)),
                "recordings": list(cell.digests),
            }


def _checks(cell: CellResult) -> Iterator[dict[str, Any]]:
    """The checks with the exercise's own points, of which the release may make others."""
    for verdict in cell.verdicts:
        yield {
            "check": verdict["name"],
            "status": verdict["status"],
            "points": verdict["earned"],
            "max_points": verdict["points"],
            **{name: verdict[name] for name in CHECK_TEXTS},
        }


def _most(release: Release, result: Result) -> float:
    """The most points of the test cells that were judged; of a refused submission, of all."""
    judged = [cell.max for note in result.notebooks for cell in note.cells]
    cells = [cell for notebook in release.notebooks.values() for cell in notebook.cells]
    return math.fsum(judged or (float(cell.metadata.nbgrader.points) for cell in cells if is_test(cell)))


def _by_hand(release: Release) -> float:
    """The points of the release that an instructor gives by hand."""
    cells = [cell for notebook in release.notebooks.values() for cell in notebook.cells if cell_name(cell)]
    graded = [cell for cell in cells if cell.metadata.nbgrader.get("grade") and not is_test(cell)]
    return math.fsum(float(cell.metadata.nbgrader.points) for cell in graded)


def _shortened(data: Any, length: float) -> Any:
    if isinstance(data, str):
        return data if len(data) <= length else f"{data[: int(length)]} [...]"
    if isinstance(data, dict):
        return {name: _shortened(value, length) for name, value in data.items()}
    if isinstance(data, list):
        return [_shortened(value, length) for value in data]
    return data
