"""Marks a class: finds what is not marked yet, marks it in a pool, and writes journal, gradebook and pages.

The order for each submission is journal, gradebook, notebooks. Each step can be repeated, and the notebooks
have the id of the marking that they show; so when a run is killed, the next one does what is left.
"""
import contextlib
import itertools
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from grader.local_time import format_local
from grader.marking import secret
from grader.marking.command.check_release import check_release
from grader.marking.command.student_pages import update_pages
from grader.marking.command.task_reader import TaskReader
from grader.marking.command.unjudged import Unjudged
from grader.marking.errors import GradebookError
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course, timestamp
from grader.marking.gradebook.due_dates import read_extensions
from grader.marking.gradebook.find_submissions import find_submissions
from grader.marking.gradebook.marked_notebooks import is_shown, marked_notebooks, write_notebooks
from grader.marking.gradebook.student_standings import Standing
from grader.marking.gradebook.time_notes import time_notes
from grader.marking.journal import Journal, JournalEntry
from grader.marking.mark_evidence import evidence
from grader.marking.progress_line import ProgressLine
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release, load_release
from grader.marking.task import MarkingTask, TaskPool


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
    """Mark what is not marked yet, and update gradebook and pages. Raises CourseError, OSError."""
    begin = time.monotonic()
    key = secret.read(course.root)
    submissions = find_submissions(course, assignment, settings.students)
    journal = Journal(course.journal(assignment))
    with journal.hold_lock(), Book(course) as book:
        worth = book.cells(assignment)
        check_release(course, assignment, worth)
        journal.save_settings(asdict(settings))
        if settings.force:
            journal.discard(submissions)
            journal.save_settings(asdict(replace(settings, force=False)))  # --resume does not repeat that
        outcome = Outcome({}, worth or {}, len(submissions))
        release = load_release(course.release(assignment))
        run = _ClassRun(course, book, journal, outcome, release, key)
        tasks = itertools.starmap(TaskReader(release, key).read, submissions.items())  # read when requested
        try:
            run.mark(tasks, lambda: open_pool(settings, key), settings.students)
            unmarked = [student for student in submissions if student not in outcome.results]
            why = run.unjudged.broken
            outcome.problems += [
                f"{student} was not marked: {why.get(student) or 'mark again'}" for student in unmarked
            ]
            run.write_late()
            outcome.standings = run.standings(assignment)
            if settings.feedback:
                outcome.problems += update_pages(
                    course, journal, assignment, outcome.results, outcome.standings, settings.jobs
                )
        except KeyboardInterrupt:
            outcome.interrupted = True
            with contextlib.suppress(KeyboardInterrupt):
                run.find_marked(tasks)  # the summary is of all results
        outcome.notes += _notes(course, assignment, submissions, bool(outcome.due))
    outcome.seconds = time.monotonic() - begin
    return outcome


def _notes(
    course: Course, assignment: str, submissions: Mapping[str, Path], due: bool
) -> Iterator[tuple[str, str]]:
    for name in course.hidden_students(assignment):
        yield name, "the folder's name begins with a dot, so it is skipped: rename it"
    yield from course.odd_folders(assignment).items()
    yield from time_notes(course, assignment, submissions, due)


class _ClassRun:
    """The run of a class: each submission is read once, and its result is either found or made by a pool.

    waiting: keys and evidence of the submissions that the pool has. late: keys of results that are in the
    journal, but not in the gradebook. Both by student. unjudged: results that were not entered so far.
    """

    def __init__(
        self, course: Course, book: Book, journal: Journal, outcome: Outcome, release: Release, secret: str
    ) -> None:
        self.course, self.book, self.journal, self.outcome = course, book, journal, outcome
        self.release, self.secret = release, secret
        self.waiting: dict[str, tuple[str, dict[str, str]]] = {}
        self.late: dict[str, str] = {}
        self.unjudged = Unjudged()

    def mark(
        self,
        tasks: Iterator[MarkingTask],
        open_pool: Callable[[], AbstractContextManager[TaskPool]],
        chosen: Sequence[str],
    ) -> None:
        """File the result of each task: the stored one, or that of a pool, which is opened if needed.

        chosen: the students who were named, if any. Raises CourseError if nothing was judged.
        """
        with contextlib.closing(ProgressLine(self.outcome.total)) as progress:
            unmarked = self._unmarked(tasks, progress)
            first = next(unmarked, None)
            if first is not None:
                with open_pool() as pool:
                    for result in pool.mark(itertools.chain([first], unmarked)):
                        self._require_requested(result)
                        if result.judged:
                            self._enter(result)
                        else:
                            self.unjudged.add(result)
                        progress.add_result(result)
        for result in self.unjudged.release(self.outcome.results, chosen):
            self._enter(result)

    def _enter(self, result: Result) -> None:
        """Store a new result, and file it."""
        self.file(self.journal.save(result, self.waiting.pop(result.student)[1]))
        self.outcome.fresh.append(result.student)

    def find_marked(self, tasks: Iterator[MarkingTask]) -> None:
        """File the stored results of tasks; the others are left."""
        for _ in self.journal.unmarked(tasks, self.file):
            pass

    def _unmarked(self, tasks: Iterator[MarkingTask], progress: ProgressLine) -> Iterator[MarkingTask]:
        def found(entry: JournalEntry) -> None:
            self.file(entry)
            progress.skip()

        for task in self.journal.unmarked(tasks, found):
            self.waiting[task.student] = task.key, evidence(task, self.secret)
            yield task

    def _require_requested(self, result: Result) -> None:
        """Raise RuntimeError for a result of another task."""
        key, _ = self.waiting.get(result.student, ("", {}))
        if (result.assignment, result.key) != (self.release.assignment, key):
            raise RuntimeError(f"the pool returned a result for {result.student} that was not requested")

    def file(self, entry: JournalEntry) -> None:
        """Add a result to the outcome, and update gradebook and notebooks."""
        result = entry.result
        without = [replace(note, notebook={}) for note in result.notebooks]
        self.outcome.results[result.student] = replace(result, notebooks=without)
        if self.late:  # another program holds the gradebook: waiting for it each time would delay the marking
            self.late[result.student] = result.key
            return
        try:
            self.write(entry)
        except GradebookError:
            self.late[result.student] = result.key

    def write(self, entry: JournalEntry) -> None:
        """Update gradebook and notebooks, unless they have this result. Raises GradebookError, OSError."""
        result, shown = entry.result, marked_notebooks(entry, self.release)
        when, text = timestamp(self.course.submitted(result.student, result.assignment))
        if is_shown(self.course, entry, shown) and self.book.has(result.assignment, result.student, when):
            return
        self.book.write(result, shown, when)
        write_notebooks(self.course, result, shown, text)

    def write_late(self) -> None:
        """Write again what the gradebook did not take. The journal has all of it."""
        for done, (student, key) in enumerate(self.late.items()):
            entry = self.journal.find(student, key)
            try:
                if entry:
                    self.write(entry)
            except GradebookError as error:
                left = f"{len(self.late) - done} marked submissions are not in it yet, and nothing is lost"
                self.outcome.problems.append(f"{error}. {left}.")
                return

    def standings(self, assignment: str) -> dict[str, Standing]:
        """What the gradebook says of all students; {} if it can't be read."""
        try:
            extensions = read_extensions(self.course).get(assignment, {})
            if due := self.book.due_dates().get(assignment):
                self.outcome.due = f"{assignment} is due on {format_local(due)}."
            return self.book.standings(assignment, extensions)
        except GradebookError:
            return {}  # it is among the problems already
