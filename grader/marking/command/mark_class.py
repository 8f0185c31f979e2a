"""Marks a class in three steps: mark what is not marked yet, publish the results, report.

The order for each submission is journal, gradebook, notebooks. Each step can be repeated, and the notebooks
have the id of the marking that they show; so when a run is killed, the next one does what is left.
"""
import contextlib
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from grader.marking import secret
from grader.marking.command.check_release import check_release
from grader.marking.command.marker import Marker
from grader.marking.command.publisher import Publisher
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.find_submissions import find_submissions
from grader.marking.gradebook.student_standings import Standing
from grader.marking.gradebook.time_notes import time_notes
from grader.marking.journal import Journal
from grader.marking.result import Result
from grader.marking.submission.assignment_release import load_release
from grader.marking.task import TaskPool


@dataclass(frozen=True)
class Settings:
    """The settings of a run: plain data, stored for --resume.

    students: only these, if any. force: mark again what has already been marked. jobs: submissions at a time.
    unsafe: without the sandbox. feedback: make the students' pages. csv, html: files for the summary, or "".
    dask: the address of a Dask scheduler whose workers mark; "" to mark here.
    """

    students: list[str] = field(default_factory=list)
    force: bool = False
    jobs: int = 1
    unsafe: bool = False
    feedback: bool = True
    csv: str = ""
    html: str = ""
    dask: str = ""


OpenPool = Callable[[Settings, str], AbstractContextManager[TaskPool]]  # from settings and secret


@dataclass
class Outcome:
    """The outcome of a run.

    results: of all submissions that are marked, now or before, by student; without the notebooks' contents.
    worth: the points of each test cell, by notebook and cell. fresh: the students marked now. seconds: of the
    whole run. problems: a sentence for each thing that is left to do. standings: what the gradebook says, by
    student. notes: of whom, and what the instructor should know. due: a sentence on the due date,
    if there is one. interrupted: whether Ctrl-C ended it.
    """

    results: dict[str, Result]
    worth: dict[tuple[str, str], float]
    total: int
    fresh: list[str] = field(default_factory=list)
    seconds: float = 0.0
    problems: list[str] = field(default_factory=list)
    standings: dict[str, Standing] = field(default_factory=dict)
    notes: list[tuple[str, str]] = field(default_factory=list)
    due: str = ""
    interrupted: bool = False


def mark_class(course: Course, assignment: str, settings: Settings, open_pool: OpenPool) -> Outcome:
    """Mark what is not marked yet, publish it, and report. Raises CourseError, OSError."""
    begin = time.monotonic()
    key = secret.read(course.root)
    submissions = find_submissions(course, assignment, settings.students)
    journal = Journal(course.journal(assignment))
    with journal.hold_lock(), Book(course) as book:
        worth = book.cells(assignment)
        check_release(course, assignment, worth)
        _save(settings, journal, submissions)
        release = load_release(course.release(assignment))
        publisher = Publisher(course, book, journal, release)
        marker = Marker(submissions, journal, release, key, publisher.publish)
        outcome = Outcome(publisher.results, worth or {}, len(submissions), marker.fresh)
        try:
            marker.mark(lambda: open_pool(settings, key), settings.students)
            # Publish what the gradebook has not taken yet, and the pages.
            outcome.problems += [*marker.problems(), *publisher.publish_late()]
            outcome.standings, outcome.due = publisher.standings(), publisher.due
            if settings.feedback:
                outcome.problems += publisher.make_pages(outcome.standings, settings.jobs)
        except KeyboardInterrupt:
            outcome.interrupted = True
            with contextlib.suppress(KeyboardInterrupt):
                marker.enter_marked()  # the summary is of all results
        # Report.
        outcome.notes += _notes(course, assignment, submissions, bool(outcome.due))
    outcome.seconds = time.monotonic() - begin
    return outcome


def _save(settings: Settings, journal: Journal, submissions: Mapping[str, Path]) -> None:
    """Save the settings for --resume, which does not repeat --force."""
    journal.save_settings(asdict(settings))
    if settings.force:
        journal.discard(submissions)
        journal.save_settings(asdict(replace(settings, force=False)))


def _notes(
    course: Course, assignment: str, submissions: Mapping[str, Path], due: bool
) -> Iterator[tuple[str, str]]:
    for name in course.hidden_students(assignment):
        yield name, "the folder's name begins with a dot, so it is skipped: rename it"
    yield from course.odd_folders(assignment).items()
    yield from time_notes(course, assignment, submissions, due)
