"""Summarizes a marked class for the instructor: points, common mistakes, times, what to look at."""
import math
import re
import statistics
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from grader.diagnosis.fault import NOT_STARTED
from grader.marking.gradebook.student_standings import Standing
from grader.marking.result import CellResult, Result
from grader.marking.submission.quoting import quote

SLOWEST = 5
FEW = 0.5  # of the points
NUMBER = re.compile(r"\d+(\.\d+)?(e[+-]?\d+)?")


@dataclass(frozen=True)
class StudentRow:
    """A student's row in the class table; points by notebook and cell. late: days, and what they cost."""

    student: str
    points: dict[tuple[str, str], float]
    total: float
    verdict: str
    flags: int
    late: str = ""


@dataclass(frozen=True)
class CommonMistake:
    """A check that students missed, with the most frequent texts (the numbers are one student's)."""

    exercise: str
    sentence: str
    students: int
    saw: str
    hint: str


@dataclass(frozen=True)
class Concern:
    """Something that the instructor should look at, of a student or a cell."""

    whose: str
    what: str


@dataclass(frozen=True)
class MarkingTimes:
    """Seconds per submission, median and longest; and the cells with the longest median."""

    median: float
    longest: float
    cells: list[tuple[str, float]]


@dataclass(frozen=True)
class Summary:
    """The summary of a marked class. worth: the points of each test cell. names: their titles.

    unstarted: how many students did not begin an exercise, for those that some did not begin. version: of
    the course's code that judged.
    """

    assignment: str
    worth: Mapping[tuple[str, str], float]
    names: dict[tuple[str, str], str]
    rows: list[StudentRow]
    unstarted: dict[str, int]
    mistakes: list[CommonMistake]
    concerns: list[Concern]
    times: MarkingTimes | None
    version: str = ""

    @property
    def any_late(self) -> bool:
        """Return whether a submission was late."""
        return any(row.late for row in self.rows)


def summarize(
    assignment: str,
    worth: Mapping[tuple[str, str], float],
    results: Mapping[str, Result],
    standings: Mapping[str, Standing] | None = None,
    notes: Iterable[tuple[str, str]] = (),
    version: str = "",
) -> Summary:
    """Summarize the results of a class. worth: points by notebook and cell. results: by student.

    standings: what the gradebook says of these students. notes: further concerns, of whom and what. version:
    of the course's code that judged.
    """
    standings = standings or {}
    ordered = [results[student] for student in sorted(results)]
    names = dict.fromkeys(worth, "")
    for result in ordered:
        names |= {key: cell.exercise for key, cell in cells(result) if key in names}
    titles = {key: name or key[1] for key, name in names.items()}
    concerns = [Concern(*note) for note in notes]
    concerns += _by_hand(worth, ordered, standings)
    concerns += [concern for result in ordered for concern in _concerns(result)]
    every = [(result.student, cell) for result in ordered for _, cell in cells(result)]
    unstarted = Counter(cell.exercise for _, cell in every if _is_unstarted(cell))
    begun = [(student, cell) for student, cell in every if not _is_unstarted(cell)]
    rows, times = [_student_row(each, standings.get(each.student)) for each in ordered], _times(ordered)
    return Summary(assignment, worth, titles, rows, unstarted, _mistakes(begun), concerns, times, version)


def cells(result: Result) -> Iterator[tuple[tuple[str, str], CellResult]]:
    """Yield every test cell of a result, by notebook and cell."""
    for notebook in result.notebooks:
        for cell in notebook.cells:
            yield (notebook.name, cell.cell), cell


def missed_checks(cell: CellResult) -> list[dict[str, Any]]:
    """The verdicts of the checks that the student missed."""
    return [verdict for verdict in cell.verdicts if verdict.get("status") == "failed"]


def _student_row(result: Result, standing: Standing | None) -> StudentRow:
    """With points by hand and the penalty, where the gradebook has them."""
    points, late, penalty = {key: cell.points for key, cell in cells(result)}, "", 0.0
    if standing:
        points |= {key: standing.points[key] or 0.0 for key in standing.by_hand}
        penalty = standing.penalty
        if standing.days_late:
            late = f"{standing.days_late:.1f} d: -{penalty:g}"
    total = max(0.0, math.fsum(points.values()) - penalty)
    return StudentRow(result.student, points, total, result.verdict, len(result.flags), late)


def _is_unstarted(cell: CellResult) -> bool:
    return any(verdict["sentence"] == NOT_STARTED for verdict in missed_checks(cell))


def _mistakes(marked: list[tuple[str, CellResult]]) -> list[CommonMistake]:
    """Checks that were missed, the most frequent first. Texts that differ in numbers alone count as equal."""
    seen: dict[tuple[str, str, str], dict[str, tuple[str, str]]] = {}
    for student, cell in marked:
        for verdict in missed_checks(cell):
            who = seen.setdefault((cell.exercise, verdict["name"], verdict["sentence"]), {})
            who[student] = (verdict["saw"], verdict["hint"])
    found = [
        CommonMistake(exercise, sentence, len(who), *_most_frequent(list(who.values())))
        for (exercise, _, sentence), who in seen.items()
    ]
    return sorted(found, key=lambda mistake: -mistake.students)


def _most_frequent(words: list[tuple[str, str]]) -> tuple[str, str]:
    kinds = [tuple(NUMBER.sub("#", part) for part in pair) for pair in words]
    (most, _), *_ = Counter(kinds).most_common(1)
    return words[kinds.index(most)]


def _by_hand(
    worth: Mapping[tuple[str, str], float], results: list[Result], standings: Mapping[str, Standing]
) -> Iterator[Concern]:
    """How many answers of each cell are still to be marked by hand."""
    none = Standing({})
    ran = [
        {key for key, _ in cells(result)} | standings.get(result.student, none).by_hand
        for result in results
        if result.verdict != "refused"
    ]
    for key in worth:
        waiting = sum(key not in marked for marked in ran)
        if waiting:
            answers = "1 answer has" if waiting == 1 else f"{waiting} answers have"
            yield Concern("/".join(key), f"{answers} to be marked by hand, in the formgrader")


def _concerns(result: Result) -> Iterator[Concern]:
    if result.verdict in ("refused", "stopped"):
        yield Concern(result.student, f"{result.verdict}: {result.reason}")
    yield from _repaired_with_few_points(result)
    unsure = {f"The test cell {quote(cell.cell)}:" for _, cell in cells(result) if cell.needs_look}
    for flag in result.flags:
        by_hand = " Set its points by hand." if flag.startswith(tuple(unsure)) else ""
        yield Concern(result.student, f"{flag}{by_hand}")
    for (notebook, name), cell in cells(result):
        flagged = any(flag.startswith(f"The test cell {quote(name)}:") for flag in result.flags)
        if cell.needs_look and not flagged:
            alarms = [str(verdict.get("alarm", "")).strip() for verdict in cell.verdicts]
            last = next((alarm.splitlines()[-1] for alarm in alarms if alarm), "see its outputs")
            what = f"a check of {notebook}/{name} is broken ({last}): set the points by hand"
            yield Concern(result.student, what)


def _repaired_with_few_points(result: Result) -> Iterator[Concern]:
    """A repaired submission with few points: the repair may be wrong."""
    most = math.fsum(cell.max for _, cell in cells(result))
    if result.repairs and result.verdict != "refused" and result.points < FEW * most:
        earned = f"repaired, and has {result.points:g} of {most:g} points"
        yield Concern(result.student, f"{earned}: {' '.join(result.repairs)}")


def _times(results: list[Result]) -> MarkingTimes | None:
    totals = [result.timings["total"] for result in results if "total" in result.timings]
    if not totals:
        return None
    spent: dict[str, list[float]] = {}
    for result in results:
        for name, seconds in result.timings.items():
            if "/" in name:  # a cell's; the others are of the whole submission
                spent.setdefault(name, []).append(seconds)
    medians = [(name, statistics.median(times)) for name, times in spent.items()]
    slowest = sorted(medians, key=lambda cell: -cell[1])[:SLOWEST]
    return MarkingTimes(statistics.median(totals), max(totals), slowest)
