"""What marking a class would change: submissions are judged, and nothing is written anywhere."""
import contextlib
import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from grader.marking import secret
from grader.marking.command.check_release import check_release
from grader.marking.command.mark_class import OpenPool, Settings
from grader.marking.command.task_reader import TaskReader
from grader.marking.command.unjudged import Unjudged
from grader.marking.gradebook.book import Book, GradebookMark
from grader.marking.gradebook.course import Course, timestamp
from grader.marking.gradebook.dry_book import DryBook
from grader.marking.gradebook.due_dates import read_extensions
from grader.marking.gradebook.find_submissions import find_submissions
from grader.marking.gradebook.marked_notebooks import marked_notebooks
from grader.marking.journal import Journal, JournalEntry
from grader.marking.mark_evidence import evidence
from grader.marking.progress_line import ProgressLine, printable
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release, load_release
from grader.marking.task import MarkingTask
from grader.marking.version import course_version

REASONS = {
    "submission": "the submission has changed",
    "release": "the assignment has changed",
    "secret": "there is another secret",
    "course": "the course's code has changed",
}
COURSE = "course"
NEAR = 1e-6  # of a point


@dataclass(frozen=True)
class MarkChange:
    """A mark that would change. now, then: points with penalties, None without a mark. why: sentences."""

    student: str
    now: float | None
    then: float
    why: list[str]


@dataclass
class Rehearsal:
    """The outcome of a dry run. judged: the students who were judged again, with the reason.

    before: the versions of the course that marked them. broken: why a student could not be judged.
    """

    total: int
    judged: dict[str, str] = field(default_factory=dict)
    changes: list[MarkChange] = field(default_factory=list)
    before: set[str] = field(default_factory=set)
    broken: dict[str, str] = field(default_factory=dict)

    def lines(self, assignment: str) -> Iterator[str]:
        """Return what would change, for a terminal."""
        if self.changes:
            yield "Marks that would change"
        for change in self.changes:
            now = "none" if change.now is None else f"{change.now:g}"
            yield printable(f"  {change.student}: {now} -> {change.then:g}: {'; '.join(change.why)}")
        for student, why in sorted(self.broken.items()):
            yield printable(f"  {student}: could not be judged. {why}")
        older = f"{', '.join(sorted(self.before))} -> " if self.before else ""
        yield f"Version of the course: {older}{course_version()}"
        yield (
            f"{len(self.changes)} of {self.total} marks of {assignment} would change, after judging "
            f"{len(self.judged)} again. Nothing was written."
        )


def rehearse(course: Course, assignment: str, settings: Settings, open_pool: OpenPool) -> Rehearsal:
    """Judge what `mark` would judge, and compare the marks. Raises CourseError, OSError."""
    key = secret.read(course.root)
    submissions = find_submissions(course, assignment, settings.students)
    with Book(course) as book:
        check_release(course, assignment, book.cells(assignment))
    release = load_release(course.release(assignment))
    outcome, unjudged = Rehearsal(len(submissions)), Unjudged()
    entries: dict[str, JournalEntry] = {}
    tasks = _unmarked(course, release, key, submissions, settings.force, entries, outcome)
    first = next(tasks, None)
    if first is not None:
        with open_pool(settings, key) as pool, contextlib.closing(ProgressLine(len(submissions))) as progress:
            for result in pool.mark(itertools.chain([first], tasks)):
                if not result.judged:
                    unjudged.add(result)
                else:
                    entries[result.student] = JournalEntry("", _light(result))
                progress.add_result(result)
    for result in unjudged.release(entries, settings.students):
        entries[result.student] = JournalEntry("", _light(result))
    outcome.broken = unjudged.broken
    outcome.changes = _compare(course, release, entries, outcome.judged)
    return outcome


def _unmarked(
    course: Course, release: Release, key: str, submissions: Mapping[str, Path], force: bool,
    entries: dict[str, JournalEntry], outcome: Rehearsal,
) -> Iterator[MarkingTask]:
    """Yield what has to be judged, with the reason in the outcome; the stored results go to `entries`."""
    journal, reader = Journal(course.journal(release.assignment)), TaskReader(release, key)
    for student, folder in submissions.items():
        task, last = reader.read(student, folder), journal.last(student)
        if last and last.result.key == task.key and not force:
            entries[student] = JournalEntry(last.id, _light(last.result))
            continue
        outcome.judged[student] = _reason(last, evidence(task, key))
        if last and (version := last.evidence.get(COURSE, "")) != course_version():
            outcome.before.add(version or "an older one")
        yield task


def _reason(last: JournalEntry | None, now: Mapping[str, str]) -> str:
    if last is None:
        return "it was not marked yet"
    found = [text for name, text in REASONS.items() if last.evidence.get(name) != now[name]]
    return " and ".join(found) or "it is judged again, as --force requests"


def _light(result: Result) -> Result:
    """Without the outputs, which may be large."""
    for note in result.notebooks:
        for cell in note.notebook["cells"]:
            cell.pop("outputs", None)
    return result


def _compare(
    course: Course, release: Release, entries: Mapping[str, JournalEntry], judged: Mapping[str, str]
) -> list[MarkChange]:
    """The marks that would change, by writing all of it into a gradebook that isn't stored."""
    name = release.assignment
    extensions = read_extensions(course).get(name, {})
    with DryBook(course) as book:
        before = _marks(book, name)
        for student, entry in entries.items():
            when, _ = timestamp(course.submitted(student, name))
            if student in judged or not book.has(name, student, when):
                book.write(entry.result, marked_notebooks(entry, release), when)
        book.standings(name, extensions)
        after = _marks(book, name)
    changes = (_change(before.get(who), after[who], judged.get(who)) for who in sorted(entries))
    return [change for change in changes if change]


def _marks(book: Book, assignment: str) -> dict[str, GradebookMark]:
    return {mark.student: mark for mark in book.marks() if mark.assignment == assignment}


def _change(now: GradebookMark | None, then: GradebookMark, reason: str | None) -> MarkChange | None:
    if now and abs(now.points - then.points) < NEAR:
        return None
    why = [reason] if reason else []
    cells = now.by_marking if now else {}
    for (notebook, cell), points in then.by_marking.items():
        if now and points != cells.get((notebook, cell)):
            why.append(f"{notebook}/{cell} {_points(cells.get((notebook, cell)))} -> {_points(points)}")
    if now and now.penalty != then.penalty:
        why.append(f"penalty for being late {now.penalty:g} -> {then.penalty:g}")
    return MarkChange(then.student, now.points if now else None, then.points, why)


def _points(points: float | None) -> str:
    return "none" if points is None else f"{points:g}"
