"""What a certificate says: plain data, and the words of it that stand on the page."""
from __future__ import annotations

from dataclasses import asdict, dataclass
from datetime import date
from typing import Any

from grader.page import number


@dataclass(frozen=True)
class Mark:
    """What a student has in one assignment.

    title: as its notebook says. digest: hexadecimal SHA-256 of the result of marking, which names what was
    handed in, the release, the secret and the version that marked.
    """

    assignment: str
    title: str
    points: float
    most: float
    digest: str


@dataclass(frozen=True)
class Certificate:
    """What is certified of a student.

    issuer: who gives it, and how to reach them. version: of the course. issued: the day, as YYYY-MM-DD.
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
        """As JSON holds it."""
        return asdict(self)

    @staticmethod
    def from_data(data: dict[str, Any]) -> Certificate:
        """From `to_data`. Raises TypeError or KeyError for anything else."""
        return Certificate(**{**data, "marks": tuple(Mark(**mark) for mark in data["marks"])})

    def shown(self) -> dict[str, str]:
        """The words on the page, by what they tell; those of a mark end with its assignment."""
        words = {
            "name": self.name,
            "student id": self.student,
            "issuer": self.issuer,
            "date": day(self.issued),
            "course version": self.version,
            "share that passes": f"{number(self.least)} %",
            "number of assignments": f"{len(self.marks)} of {self.assignments}",
        }
        for mark in self.marks:
            words[f"title of {mark.assignment}"] = mark.title
            words[f"score of {mark.assignment}"] = score(mark)
            words[f"digest of {mark.assignment}"] = mark.digest
        return words


def score(mark: Mark) -> str:
    """Points of points."""
    return f"{number(mark.points)} of {number(mark.most)}"


def day(iso: str) -> str:
    """A date such as 22 November 2026, which no country reads otherwise."""
    found = date.fromisoformat(iso)
    return f"{found.day} {found:%B %Y}"
