"""Fills the marks of a class into a platform's file, and lists everything that can't be filled in."""
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from grader.marking.extras.learning_platform.grade_sheet import GradeSheet
from grader.marking.extras.learning_platform.platform_users import KnownStudent, match_users
from grader.marking.gradebook.book import GradebookMark


@dataclass(frozen=True)
class PlatformMark:
    """A student's points. doubt: why they can't be reported yet, or ""."""

    points: float
    doubt: str = ""


@dataclass
class FillReport:
    """A report on what was filled in, and a sentence for each thing that was not. students: by record."""

    filled: int = 0
    students: dict[int, str] = field(default_factory=dict)
    replaced: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)


def marks_of(marks: Sequence[GradebookMark], assignment: str) -> tuple[dict[str, PlatformMark], float]:
    """The marks of an assignment by student, and its points; of all that is marked if it is ""."""
    chosen = [mark for mark in marks if assignment in ("", mark.assignment)]
    most = math.fsum({mark.assignment: mark.most for mark in chosen}.values())
    found: dict[str, PlatformMark] = {}
    for mark in chosen:
        before = found.get(mark.student, PlatformMark(0.0))
        doubt = f"{mark.assignment} still needs a look in the formgrader" if mark.needs_look else ""
        found[mark.student] = PlatformMark(before.points + mark.points, before.doubt or doubt)
    return found, most


def fill_grades(
    sheet: GradeSheet, marks: Mapping[str, PlatformMark], most: float, students: Sequence[KnownStudent]
) -> FillReport:
    """Fill the marks into the sheet, converted to its maximum. most: the points of the marks."""
    report, records = FillReport(), list(sheet.people)
    matches = match_users([sheet.people[at] for at in records], students)
    report.students = {records[at]: student for at, student in matches.found.items()}
    for at, record in enumerate(records):
        who = sheet.people[record].label
        if at in matches.ambiguous:
            may_be = " or ".join(matches.ambiguous[at])
            report.problems.append(f"{who}: may be {may_be}, and is not filled in")
        elif at not in matches.found:
            report.problems.append(f"{who}: unknown to the gradebook")
        else:
            _fill(sheet, record, matches.found[at], marks, most, report)
    known = {*matches.found.values(), *(each for them in matches.ambiguous.values() for each in them)}
    missing = sorted(marks.keys() - known)
    report.problems += [f"{student}: has a mark, and is not in the file" for student in missing]
    return report


def _fill(
    sheet: GradeSheet,
    record: int,
    student: str,
    marks: Mapping[str, PlatformMark],
    most: float,
    report: FillReport,
) -> None:
    mark = marks.get(student)
    reason = sheet.fixed.get(record) or ("has no mark" if mark is None else mark.doubt)
    if reason or mark is None:
        report.problems.append(f"{student}: {reason}, and is not filled in")
        return
    before = sheet.fill(record, mark.points * sheet.most / most)
    report.filled += 1
    if before:
        now = sheet.file.new_value(record, sheet.column)
        report.replaced.append(f"{student}: had {before}, and has {now} now")
