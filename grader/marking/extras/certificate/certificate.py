"""The content of a certificate as plain data, and its fields on the page."""
from __future__ import annotations

from dataclasses import asdict, dataclass
from datetime import date
from typing import Any

from grader.page import format_points


@dataclass(frozen=True)
class Mark:
    """A student's mark for one assignment.

    title: that of its notebook. digest: hexadecimal SHA-256 of the result of marking, whose key names the
    submission, the release, the secret and the version that marked.
    """

    assignment: str
    title: str
    points: float
    most: float
    digest: str


@dataclass(frozen=True)
class Certificate:
    """What is certified of a student.

    issuer: name and contact of the instructor. version: of the course. issued: the date, as YYYY-MM-DD.
    least: percent of the points that pass. assignments: how many the course has. marks: those that passed.
    """

    student: str
    name: str
    issuer: str
    version: str
    issued: str
    least: float
    assignments: int
    marks: tuple[Mark, ...]

    def to_data(self) -> dict[str, Any]:
        """As plain data for JSON."""
        return asdict(self)

    @staticmethod
    def from_data(data: dict[str, Any]) -> Certificate:
        """From `to_data`. Raises TypeError or KeyError for anything else."""
        return Certificate(**{**data, "marks": tuple(Mark(**mark) for mark in data["marks"])})

    def fields(self) -> dict[str, str]:
        """The texts on the page, by field; the fields of a mark end with its assignment."""
        fields = {
            "name": self.name,
            "student id": self.student,
            "issuer": self.issuer,
            "date": format_day(self.issued),
            "course version": self.version,
            "share that passes": f"{format_points(self.least)} %",
            "number of assignments": f"{len(self.marks)} of {self.assignments}",
        }
        for mark in self.marks:
            fields[f"title of {mark.assignment}"] = mark.title
            fields[f"score of {mark.assignment}"] = format_score(mark)
            fields[f"digest of {mark.assignment}"] = mark.digest
        return fields


def format_score(mark: Mark) -> str:
    """The points, as "8 of 10"."""
    return f"{format_points(mark.points)} of {format_points(mark.most)}"


def format_day(iso: str) -> str:
    """A date such as 22 November 2026, which is unambiguous in all countries."""
    found = date.fromisoformat(iso)
    return f"{found.day} {found:%B %Y}"
