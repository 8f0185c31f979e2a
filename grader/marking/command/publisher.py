"""The second step of marking a class: its results come into gradebook, marked notebooks and pages."""

from __future__ import annotations

from dataclasses import replace

from grader.course_files.local_time import format_local
from grader.marking.command.student_pages import update_pages
from grader.marking.errors import GradebookError
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course, timestamp
from grader.marking.gradebook.due_dates import read_extensions
from grader.marking.gradebook.marked_notebooks import is_shown, marked_notebooks, write_notebooks
from grader.marking.gradebook.student_standings import Standing
from grader.marking.journal import Journal, JournalEntry
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release


class Publisher:
    """Publishes results one by one.

    results: by student; without the notebooks' contents. due: a sentence on the due date, if there is one.
    """

    def __init__(self, course: Course, book: Book, journal: Journal, release: Release) -> None:
        self._course, self._book, self._journal, self._release = course, book, journal, release
        self._late: dict[str, str] = {}  # by student: keys of what only the journal has
        self.results: dict[str, Result] = {}
        self.due = ""

    def publish(self, entry: JournalEntry) -> None:
        """Add a result to gradebook and marked notebooks; later if another program holds the gradebook."""
        result = entry.result
        without = [replace(note, notebook={}) for note in result.notebooks]
        self.results[result.student] = replace(result, notebooks=without)
        if self._late:  # waiting for the other program each time would delay the marking
            self._late[result.student] = result.key
            return
        try:
            self._write(entry)
        except GradebookError:
            self._late[result.student] = result.key

    def publish_late(self) -> list[str]:
        """Write again what the gradebook did not take; return a sentence if it still doesn't take it."""
        for done, (student, key) in enumerate(self._late.items()):
            entry = self._journal.find(student, key)
            try:
                if entry:
                    self._write(entry)
            except GradebookError as error:
                left = f"{len(self._late) - done} marked submissions are not in it yet, and nothing is lost"
                return [f"{error}. {left}."]
        return []

    def standings(self) -> dict[str, Standing]:
        """Return what the gradebook says of all students; {} if it can't be read."""
        assignment = self._release.assignment
        try:
            extensions = read_extensions(self._course).get(assignment, {})
            if due := self._book.due_dates().get(assignment):
                self.due = f"{assignment} is due on {format_local(due)}."
            return self._book.standings(assignment, extensions)
        except GradebookError:
            return {}  # it is among the problems already

    def make_pages(self, standings: dict[str, Standing], jobs: int) -> list[str]:
        """Make the students' pages that are out of date; return a sentence for each that failed."""
        return update_pages(
            self._course, self._journal, self._release.assignment, self.results, standings, jobs
        )

    def _write(self, entry: JournalEntry) -> None:
        """Update gradebook and notebooks, unless they have this result. Raises GradebookError, OSError."""
        result, shown = entry.result, marked_notebooks(entry, self._release)
        when, text = timestamp(self._course.submitted(result.student, result.assignment))
        if is_shown(self._course, entry, shown) and self._book.has(result.assignment, result.student, when):
            return
        self._book.write(result, shown, when)
        write_notebooks(self._course, result, shown, text)
