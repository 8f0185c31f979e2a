"""Reads and writes nbgrader's gradebook, as `nbgrader autograde` does."""
import contextlib
from collections.abc import Collection, Iterator, Mapping
from datetime import datetime
from types import TracebackType

from nbformat import NotebookNode
from nbgrader.api import Grade, Gradebook, InvalidEntry, MissingEntry, Student, SubmittedNotebook
from nbgrader.utils import compute_checksum, determine_grade, is_grade, is_solution, is_task
from sqlalchemy.engine import make_url
from sqlalchemy.exc import SQLAlchemyError

from grader.marking.errors import GradebookError
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.gradebook_rows import GradebookMark, GradebookStudent, read_mark
from grader.marking.gradebook.student_standings import Standing, extend, penalize, read_standings
from grader.marking.result import CellResult, Result

PATIENCE = 60.0  # seconds to wait for a locked SQLite file, if its address has no timeout
NO_RESPONSE = "No response."  # nbgrader's own comment on an untouched answer
ADVICE = {
    "locked": "another program has locked it: close the formgrader's page or wait, then mark again",
    "readonly": "it is read-only: mark as the user who owns it",
    "full": "the disk is full: free some space, then mark again",
    "no such": "it is another nbgrader version's: copy it, run `nbgrader db upgrade`, then mark again",
}


class Book:
    """The gradebook of a course, open for one command. Raises GradebookError."""

    def __init__(self, course: Course) -> None:
        self._app = course.app
        url = self._address = make_url(course.database)
        if url.get_backend_name() == "sqlite" and "timeout" not in url.query:
            url = url.update_query_dict({"timeout": str(PATIENCE)})
        with self._translated_errors():
            self._gradebook = Gradebook(url.render_as_string(hide_password=False), course.name)

    def __enter__(self) -> "Book":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._gradebook.close()

    def cells(self, assignment: str) -> dict[tuple[str, str], float] | None:
        """The points of each test cell by notebook and name, or None for an unknown assignment."""
        with self._transaction() as book:
            try:
                notebooks = book.find_assignment(assignment).notebooks
            except MissingEntry:
                return None
            return {(note.name, cell.name): cell.max_score for note in notebooks for cell in note.grade_cells}

    def has(self, assignment: str, student: str, timestamp: datetime | None) -> bool:
        """Return whether it has this submission, with this time."""
        with self._transaction() as book:
            try:
                submission = book.find_submission(assignment, student)
            except MissingEntry:
                return False
            return bool(submission.timestamp == timestamp)

    def marks(self) -> list[GradebookMark]:
        """All marks of the class, by assignment and student."""
        with self._transaction() as book:
            submissions = [found for each in book.assignments for found in each.submissions]
            return sorted(map(read_mark, submissions), key=lambda mark: (mark.assignment, mark.student))

    def standings(
        self, assignment: str, extensions: Mapping[str, datetime] | None = None, ended: Collection[str] = ()
    ) -> dict[str, Standing]:
        """The standings by student, with penalties for due date and extensions as they are now.

        extensions: until when (UTC), by student. ended: students who may have none any more.
        """
        with self._transaction() as book:
            submissions = book.assignment_submissions(assignment)
            for submission in submissions:
                extend(submission, extensions or {}, ended)
                for notebook in submission.notebooks:
                    penalize(self._app, book, submission, notebook)
            book.db.expire_all()
            return read_standings(submissions)

    def due_dates(self) -> dict[str, datetime | None]:
        """Return when each assignment is due (UTC)."""
        with self._transaction() as book:
            return {each.name: each.duedate for each in sorted(book.assignments, key=lambda each: each.name)}

    def set_due_date(self, assignment: str, when: datetime | None) -> None:
        """Set or remove a due date (UTC)."""
        with self._transaction() as book:
            book.find_assignment(assignment).duedate = when

    def students(self) -> list[GradebookStudent]:
        """Everyone in the gradebook."""
        with self._transaction() as book:
            every = [(each.id, each.first_name, each.last_name, each.email) for each in book.students]
        return [GradebookStudent(*(text or "" for text in each)) for each in every]

    def write(self, result: Result, pages: Mapping[str, NotebookNode], timestamp: datetime | None) -> None:
        """Write a result: all of it, or nothing if this raises.

        pages: the notebooks as they were marked, with nbgrader's metadata, by name. timestamp: UTC, None if
        it isn't known. Points entered by hand stay, and are marked for another look, as after nbgrader's own.
        """
        with self._transaction() as book:
            _name(book.update_or_create_student(result.student))
            with book.db.no_autoflush:  # the submission must not be in the session before it is complete
                book.update_or_create_submission(result.assignment, result.student, timestamp=timestamp)
            book.db.expire_all()  # so that the rows of nbgrader's methods are read again
            submission = book.find_submission(result.assignment, result.student)
            for notebook in submission.notebooks:
                _enter(notebook, result, _graded_cells(pages.get(notebook.name)))
                penalize(self._app, book, submission, notebook)

    @contextlib.contextmanager
    def _transaction(self) -> Iterator[Gradebook]:
        """Commit all changes inside together, or none; nbgrader's methods would commit each by itself."""
        session = self._gradebook.db
        commit = session.commit
        session.commit = session.flush
        try:
            with self._translated_errors():
                yield self._gradebook
                commit()
        finally:
            session.commit = commit
            session.rollback()
            session.remove()

    @contextlib.contextmanager
    def _translated_errors(self) -> Iterator[None]:
        try:
            yield
        except (SQLAlchemyError, InvalidEntry) as error:
            first = error.__context__ if isinstance(error, InvalidEntry) else error  # nbgrader wraps some
            reason = str(getattr(first, "orig", first)).strip()
            advice = (text for sign, text in ADVICE.items() if sign in reason)
            place = self._address.render_as_string(hide_password=True)
            problem = f"the gradebook {place} can't be used ({reason})"
            raise GradebookError(f"{problem}: {next(advice, 'repair it, then mark again')}") from None


def _name(student: Student) -> None:
    """Set a missing name, which the formgrader would show as "None, None"."""
    if student.first_name is None and student.last_name is None:
        student.first_name, student.last_name = "", student.id


def _graded_cells(page: NotebookNode | None) -> dict[str, NotebookNode]:
    """The cells of a notebook that are in the gradebook, by name and in order."""
    cells = [] if page is None else page.cells
    kinds = (is_grade, is_solution, is_task)
    return {cell.metadata.nbgrader.grade_id: cell for cell in cells if any(kind(cell) for kind in kinds)}


def _enter(notebook: SubmittedNotebook, result: Result, cells: Mapping[str, NotebookNode]) -> None:
    """Set scores and comments of one notebook."""
    earned = {
        cell.cell: cell for note in result.notebooks if note.name == notebook.name for cell in note.cells
    }
    refused = result.verdict == "refused" or not cells
    for grade in notebook.grades:
        if refused:
            grade.auto_score, grade.needs_manual_grade = 0, False
        else:
            _score(grade, earned.get(grade.name), cells.get(grade.name))
    for comment in notebook.comments:
        comment.auto_comment = _no_response(cells.get(comment.name))
    if result.verdict == "refused":
        comments = {comment.name: comment for comment in notebook.comments}
        first = next((comments[name] for name in cells if name in comments), None)
        if first:
            first.auto_comment = result.reason


def _score(grade: Grade, earned: CellResult | None, cell: NotebookNode | None) -> None:
    """Set the points of one cell, and whether an instructor has to look at it."""
    if cell is not None and is_task(cell):
        return  # these are marked by hand only
    look = False
    if earned is not None:
        grade.auto_score = min(earned.points, grade.max_score)
        look = earned.needs_look or earned.max != grade.max_score
    elif cell is not None and (is_solution(cell) or cell.cell_type != "code"):
        grade.auto_score, _ = determine_grade(cell)
    else:
        grade.auto_score, look = 0, True  # a test that never ran
    grade.needs_manual_grade = look or grade.manual_score is not None or grade.auto_score is None


def _no_response(cell: NotebookNode | None) -> str | None:
    """Nbgrader's comment, if the answer is as in the release."""
    if cell is None or is_task(cell):
        return None
    return NO_RESPONSE if cell.metadata.nbgrader.get("checksum") == compute_checksum(cell) else None
