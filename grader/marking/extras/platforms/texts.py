"""What a student reads of a result, as plain text or as HTML; the same on each platform."""

import html
from collections.abc import Mapping
from typing import Any

from grader.marking.progress_line import printable

MARKS = {"passed": "passed", "failed": "failed", "skipped": "not judged", "broken": "not judged"}


def check_text(check: Mapping[str, Any]) -> str:
    """Return what was expected, what was seen and what to do next; "" for a check that passed."""
    return _plain("\n".join(f"{name}: {text}" for name, text in _parts(check)))


def check_html(check: Mapping[str, Any]) -> str:
    """Return the same as well-formed HTML, in which nothing of a student's text is markup."""
    return "".join(f"<p><b>{name}:</b> {_escaped(text)}</p>" for name, text in _parts(check))


def exercise_note(exercise: Mapping[str, Any]) -> str:
    """A sentence where the points of an exercise are not the sum of its checks; or ""."""
    total = sum(check["points"] for check in exercise["checks"])
    points, most = exercise["points"], exercise["max_points"]
    if exercise["unsafe"] and points < total:
        return f"{exercise['exercise']}: {points:g} of {most:g} points, because the robot was unsafe."
    if not exercise["checks"]:
        return f"{exercise['exercise']}: {points:g} of {most:g} points; its nodes could not be run."
    return "" if abs(points - total) < 1e-6 else f"{exercise['exercise']}: {points:g} of {most:g} points."


def overview(data: Mapping[str, Any]) -> str:
    """The result as a whole: points, lateness, why something stopped, what was repaired."""
    return _plain("\n".join(_overview_lines(data)))


def overview_html(data: Mapping[str, Any]) -> str:
    """Return the same as well-formed HTML, in which nothing of a student's text is markup."""
    return "".join(f"<p>{_escaped(line)}</p>" for line in _overview_lines(data))


def _parts(check: Mapping[str, Any]) -> list[tuple[str, str]]:
    parts = (("Expected", check["expected"]), ("Saw", check["saw"]), ("Hint", check["hint"]))
    return [(name, text) for name, text in parts if text]


def _overview_lines(data: Mapping[str, Any]) -> list[str]:
    lines = [f"{data['points']:g} of {data['max_points']:g} points."]
    if data["late"] and data["late"]["penalty"]:
        late = data["late"]
        left = f"{late['penalty']:g} points are lost, {data['points_after_lateness']:g} remain"
        lines.append(f"Handed in {late['days']:.1f} days late: {left}.")
    if data["verdict"] == "refused":
        lines.append("Your submission could not be marked.")
    lines += [data["reason"]] if data["reason"] else []
    lines += [note for note in map(exercise_note, data["exercises"]) if note]
    lines += [f"Repaired first: {repair}" for repair in data["repairs"]]
    if data["needs_look"]:
        lines.append("Your instructor will look at some of the points.")
    if data["points_by_hand"]:
        lines.append(f"Your instructor gives up to {data['points_by_hand']:g} points more by hand.")
    return lines


def _plain(text: str) -> str:
    """Text without control characters: platforms make colors and links of some, in what a student printed."""
    return "\n".join(map(printable, text.split("\n")))


def _escaped(text: str) -> str:
    return html.escape(_plain(text)).replace("\n", "<br/>")


def instructor_text(data: Mapping[str, Any]) -> str:
    """Return what is for the instructor: flags, isolation, and what the mark was given for."""
    versions = ", ".join(f"{name} {text}" for name, text in data["evidence"].items())
    return "\n".join([*data["flags"], f"Isolation: {data['isolation']}.", f"Evidence: {versions}."])
