"""What a score becomes in a mark: points, outputs and what the instructor has to see."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from IPython.core.formatters import DisplayFormatter

from grader.checks.judge import SPOOFED_TOPICS
from grader.marking.outputs import FOR_INSTRUCTOR, mime_bundle
from grader.marking.result import CellResult
from grader.score import Score


def for_student(score: Score) -> Score:
    """The score as the student's page shows it: what broke in a check of ours is for the instructor."""
    verdicts = [replace(verdict, alarm="") for verdict in score.verdicts]
    return Score(score.exercise, verdicts, score.recordings, title=score.title)


def alarms(score: Score) -> list[str]:
    """What the instructor has to know of each check that broke."""
    return [
        f"the check {verdict.name!r} broke: {verdict.alarm.strip().splitlines()[-1]}"
        for verdict in score.broken
    ]


def staged(score: Score) -> list[str]:
    """What the instructor has to know of a topic or a service that two programs had."""
    return [
        f"{verdict.expected}; there were {verdict.saw.replace('of yours', 'of the student')}"
        for verdict in score.verdicts
        if verdict.name == SPOOFED_TOPICS
    ]


def outputs(score: Score, count: int) -> list[dict[str, Any]]:
    """A test cell's outputs, as Jupyter shows a score: pictures first, then the table."""
    bundles = []
    try:
        for caption, picture in score.pictures:
            data, _ = _formatter.format(picture)
            bundles.append(mime_bundle(data, {"image/png": {"alt": caption}} if "image/png" in data else {}))
    except Exception:  # a picture is an extra: without it the points still have to be told
        bundles = []
    table = {"text/plain": repr(score), "text/html": score._repr_html_()}
    shown = [{"output_type": "display_data", **item} for item in bundles]
    return [*shown, {"output_type": "execute_result", "execution_count": count, **mime_bundle(table, {})}]


def for_instructor(text: str) -> list[dict[str, Any]]:
    """An output with what was written while nodes were judged in private worlds; none for no text."""
    said = f"Written in private worlds; not on the student's page:\n{text}"
    shown = {"data": {"text/plain": said}, "metadata": {FOR_INSTRUCTOR: True}}
    return [{"output_type": "display_data", **shown}] if text else []


def cell_result(cell: str, score: Score, worth: float, needs_look: bool) -> CellResult:
    """The result of a test cell with this grade_id, of which the notebook says what it is `worth`."""
    digests = [recording.digest for recording in score.recordings]
    data = score.as_dict()
    points = min(float(score), worth)
    return CellResult(cell, score.exercise, points, worth, data["verdicts"], digests, needs_look)


_formatter = DisplayFormatter()
