"""Marks a class: plans, lets the pool mark, keeps each result, writes gradebook and pages.

In this order for each submission: journal, gradebook, notebooks. Each step can be done again, and the last
one names the marking it shows; so whenever a run is killed, the next one does what is left.
"""
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass, field, replace
from typing import Protocol

from grader.marking import secret
from grader.marking.office import intake
from grader.marking.office.course import Course
from grader.marking.office.feedback import is_stale, make_feedback
from grader.marking.office.gradebook import Book, GradebookError
from grader.marking.office.journal import Entry, Journal
from grader.marking.office.pages import handed_in, pages, shows, write_pages
from grader.marking.office.progress import Progress
from grader.marking.plan import Task
from grader.marking.result import Result


class Pool(Protocol):
    """Marks submissions in processes of their own."""

    def mark(self, tasks: Iterable[Task]) -> Iterator[Result]:
        """Yield the results as they are there."""


@dataclass(frozen=True)
class Settings:
    """How a run was started: plain data, kept for --resume.

    students: only these, if any. force: mark again what is marked already. jobs: submissions at a time.
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


OpenPool = Callable[[Settings, str], AbstractContextManager[Pool]]  # from settings and secret


@dataclass
class Outcome:
    """What a run did.

    results: of all submissions that are marked, now or before, by student; without the notebooks' contents.
    worth: the points of each test cell, by notebook and cell. fresh: who was marked now. seconds: of it all.
    problems: a sentence for each thing that is left to do. interrupted: whether Ctrl-C ended it.
    """

    results: dict[str, Result]
    worth: dict[tuple[str, str], float]
    total: int
    fresh: list[str] = field(default_factory=list)
    seconds: float = 0.0
    problems: list[str] = field(default_factory=list)
    interrupted: bool = False


def mark(course: Course, assignment: str, settings: Settings, open_pool: OpenPool) -> Outcome:
    """Mark what is not marked yet, and bring gradebook and pages up to date. Raises CourseError, OSError."""
    begin = time.monotonic()
    key = secret.read(course.root)
    tasks = intake.tasks(course, assignment, settings.students, key)
    journal = Journal(course.journal(assignment))
    with journal.alone(), Book(course) as book:
        worth = book.cells(assignment)
        intake.check_release(course, assignment, worth)
        journal.keep_settings(asdict(settings))
        if settings.force:
            journal.forget(task.student for task in tasks)
            journal.keep_settings(asdict(replace(settings, force=False)))  # that is done: go on from here
        outcome = Outcome({}, worth or {}, len(tasks))
        desk = _Desk(course, book, journal, outcome)
        try:
            desk.take_up(tasks)
            if desk.waiting:
                with open_pool(settings, key) as pool:
                    desk.mark(pool)
            desk.write_late()
            if settings.feedback:
                desk.give_feedback(assignment, settings.jobs)
        except KeyboardInterrupt:
            outcome.interrupted = True
    outcome.seconds = time.monotonic() - begin
    return outcome


class _Desk:
    """Where results come in and go out."""

    def __init__(self, course: Course, book: Book, journal: Journal, outcome: Outcome) -> None:
        self.course, self.book, self.journal, self.outcome = course, book, journal, outcome
        self.waiting: dict[str, Task] = {}
        self.late: list[Task] = []  # in the journal, but not in the gradebook

    def take_up(self, tasks: list[Task]) -> None:
        """Find what is marked already, and write what the gradebook doesn't have of it."""
        for task in tasks:
            entry = self.journal.find(task)
            if entry is None:
                self.waiting[task.student] = task
            else:
                self.file(task, entry)

    def mark(self, pool: Pool) -> None:
        """Let the pool mark what waits, and file each result as it comes."""
        progress = Progress(len(self.waiting))
        try:
            for result in pool.mark(list(self.waiting.values())):
                task = self.waiting.pop(result.student, None)
                if task is None or (task.assignment, task.key) != (result.assignment, result.key):
                    raise RuntimeError(f"a result for {result.student} came that nobody waits for")
                self.file(task, self.journal.keep(result))
                self.outcome.fresh.append(task.student)
                progress.done(result)
        finally:
            progress.close()
        self.outcome.problems += [f"{student} was not marked: mark again" for student in self.waiting]

    def file(self, task: Task, entry: Entry) -> None:
        """Note a result, and bring gradebook and notebooks up to it."""
        without = [replace(note, notebook={}) for note in entry.result.notebooks]
        self.outcome.results[task.student] = replace(entry.result, notebooks=without)
        if self.late:  # somebody holds the gradebook: asking for each result would hold up the marking
            self.late.append(task)
            return
        try:
            self.write(task, entry)
        except GradebookError:
            self.late.append(task)

    def write(self, task: Task, entry: Entry) -> None:
        """Bring gradebook and notebooks up to a result, if they aren't. Raises GradebookError, OSError."""
        when, shown = handed_in(self.course, entry.result), pages(entry, task.release)
        if shows(self.course, entry, shown) and self.book.has(task.assignment, task.student, when):
            return
        self.book.write(entry.result, shown, when)
        write_pages(self.course, entry.result, shown)

    def write_late(self) -> None:
        """Try once more what the gradebook did not take. Nothing is lost: the journal has it."""
        for done, task in enumerate(self.late):
            entry = self.journal.find(task)
            try:
                if entry:
                    self.write(task, entry)
            except GradebookError as error:
                left = f"{len(self.late) - done} marked submissions are not in it yet, and nothing is lost"
                self.outcome.problems.append(f"{error}. {left}.")
                return

    def give_feedback(self, assignment: str, jobs: int) -> None:
        """Make the pages that are missing or older than the marks."""
        stale = [name for name in sorted(self.outcome.results) if is_stale(self.course, assignment, name)]
        for student in make_feedback(self.course, assignment, stale, jobs) if stale else ():
            why = f"`nbgrader generate_feedback {assignment} --force --student {student}` says why"
            self.outcome.problems.append(f"the page of {student} could not be made: {why}")
