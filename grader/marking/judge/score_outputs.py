"""Turns a score into the points, the outputs and the instructor's flags of a mark."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from IPython.core.formatters import DisplayFormatter

from grader.checks.verdicts import SPOOFED_TOPICS
from grader.marking.outputs import FOR_INSTRUCTOR, mime_bundle
from grader.marking.result import CellResult
from grader.score import Score

NEAR = 1e-6


def for_student(score: Score) -> Score:
    """The score for the student's page: without the errors of the course's checks."""
    verdicts = [replace(verdict, alarm="") for verdict in score.verdicts]
    title, differences = score.title, score.differences
    return Score(score.exercise, verdicts, score.recordings, title=title, differences=differences)


def alarms(score: Score) -> list[str]:
    """A flag for each check that raised an error."""
    return [
        f"the check {verdict.name!r} broke: {verdict.alarm.strip().splitlines()[-1]}"
        for verdict in score.broken
    ]


def spoofed_topics(score: Score) -> list[str]:
    """A flag for each topic or service of the course that the student's program also has."""
    return [
        f"{verdict.expected}; there were {verdict.saw.replace('of yours', 'of the student')}"
        for verdict in score.verdicts
        if verdict.name == SPOOFED_TOPICS
    ]


# What a student's endpoint needs at the other end.
COUNTERPARTS = {
    "subscription": "publisher",
    "client": "service",
    "service": "client",
    "action client": "action server",
    "action server": "action client",
}
# Of every robot: a right program may drive without its sensors.
OF_ROBOTS = {
    *("/battery_state", "/bumper", "/clock", "/cmd_vel", "/imu/data", "/joint_states", "/map", "/odom"),
    *("/parameter_events", "/robot_description", "/rosout", "/scan", "/tf", "/tf_static"),
}


def unused_offers(score: Score) -> list[str]:
    """A flag for full points of nodes that receive nothing from the course's programs, though they send."""
    ends = [end for recording in score.recordings for end in recording.graph.endpoints]
    ends = [end for end in ends if not end.type.startswith("rcl_interfaces/")]
    offered = {(end.kind, end.name) for end in ends if end.from_course and end.kind in COUNTERPARTS.values()}
    used = {(COUNTERPARTS.get(end.kind), end.name) for end in ends if not end.from_course}
    names = sorted({name for _, name in offered} - OF_ROBOTS)
    if float(score) < score.max or not names or offered & used:
        return []
    offers = f"what the course's programs offer: {', '.join(names)}"
    return [f"full points, although its nodes use nothing of {offers}"]


def outputs(score: Score, count: int) -> list[dict[str, Any]]:
    """A test cell's outputs, as Jupyter shows a score: the table first, then pictures."""
    bundles = []
    try:
        for caption, picture in score.pictures:
            data, _ = _formatter.format(picture)
            bundles.append(mime_bundle(data, {"image/png": {"alt": caption}} if "image/png" in data else {}))
    except Exception:  # pictures are optional, the points are not
        bundles = []
    table = {"text/plain": repr(score), "text/html": score._repr_html_()}
    shown = [{"output_type": "display_data", **item} for item in bundles]
    return [{"output_type": "execute_result", "execution_count": count, **mime_bundle(table, {})}, *shown]


def for_instructor(text: str) -> list[dict[str, Any]]:
    """An output with what nodes printed in private worlds, for the instructor alone; none for no text."""
    text_for_instructor = f"Written in private worlds; not on the student's page:\n{text}"
    shown = {"data": {"text/plain": text_for_instructor}, "metadata": {FOR_INSTRUCTOR: True}}
    return [{"output_type": "display_data", **shown}] if text else []


def converted(score: Score, worth: float) -> float:
    """The points of a score in a notebook that gives other points than the exercise: class/course.toml."""
    if score.max == worth or not score.max:
        return float(score)
    return math.floor(float(score) / score.max * worth * 100 + NEAR) / 100


def conversion(score: Score, worth: float) -> str:
    """A sentence for the student's page where the points are converted, or ""."""
    if score.max == worth:
        return ""
    return f"{float(score):g} of {score.max:g} are {converted(score, worth):g} of {worth:g} points here."


def cell_result(cell: str, score: Score, worth: float, needs_look: bool) -> CellResult:
    """The result of a test cell with this grade_id. worth: its points in the notebook."""
    digests = [recording.digest for recording in score.recordings]
    data = score.as_dict()
    points = converted(score, worth)
    return CellResult(cell, score.exercise, points, worth, data["verdicts"], digests, needs_look)


_formatter = DisplayFormatter()
