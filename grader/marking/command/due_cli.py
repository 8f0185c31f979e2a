"""`python -m grader due`: due dates and extensions, in local time."""
import argparse
import sys
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

from grader.course_files.local_time import format_local
from grader.marking.errors import CourseError
from grader.marking.gradebook import due_dates
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.find_submissions import near
from grader.marking.lateness import FORM, parse_local
from grader.marking.progress_line import printable

DESCRIPTION = """Show due dates and extensions, or set one: of an assignment, or with --student an extension.

Times are local, such as "2026-12-01 18:00"; "none" removes one. `python -m grader mark` takes a
changed date into account. Students see the due dates on the start page of the next handout."""
NONE = "none"


def main(arguments: list[str] | None = None) -> int:
    """Run the command in the course's folder; returns the exit status."""
    form = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser("python -m grader due", description=DESCRIPTION, formatter_class=form)
    parser.add_argument("assignment", nargs="?", default="", metavar="ASSIGNMENT")
    parser.add_argument("when", nargs="?", default="", metavar="WHEN", help=f'such as "{FORM}"')
    parser.add_argument("--student", default="", metavar="NAME", help="an extension for this student")
    options = parser.parse_args(arguments)
    if options.assignment and not options.when:
        parser.error("expected the time after the assignment")
    try:
        course = Course(Path.cwd())
        with Book(course) as book:
            if options.assignment:
                _set(course, book, options)
            for line in _lines(course, book):
                print(printable(line))
    except CourseError as error:
        text = f"Nothing was changed: {error}"
        print(text if text.endswith("?") else f"{text}.", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"Stopped: {error.filename} can't be written ({error.strerror}).", file=sys.stderr)
        return 1
    return 0


def _set(course: Course, book: Book, options: argparse.Namespace) -> None:
    name, due = options.assignment, book.due_dates()
    if name not in due:
        raise CourseError(f"the gradebook doesn't know {name}: it has {', '.join(due) or 'no assignments'}")
    when = None if options.when == NONE else parse_local(options.when)
    if not options.student:
        book.set_due_date(name, when)
        due_dates.write_for_students(course, book.due_dates())
        return
    extensions = due_dates.read_extensions(course)
    those = extensions.setdefault(name, {})
    if options.student not in those:
        _require_student(course, book, options.student)
    _check_extension(name, due[name], when)
    those.pop(options.student, None)
    if when:
        those[options.student] = when
    due_dates.write_extensions(course, extensions)
    book.standings(name, those, [options.student])


def _require_student(course: Course, book: Book, student: str) -> None:
    """Raise CourseError for a student who is neither in the gradebook nor has handed anything in."""
    submitted = [name for assignment in course.assignments() for name in course.students(assignment)]
    known = {*(each.student for each in book.students()), *submitted}
    if student not in known:
        add = f"a new one is added with `nbgrader db student add {student}`"
        raise CourseError(f"there is no student {student}: {near(student, known) or add}")


def _check_extension(name: str, due: datetime | None, when: datetime | None) -> None:
    if due is None:
        raise CourseError(f"{name} has no due date that could be extended: set one first")
    if when and when < due:
        raise CourseError(f"an extension ends after {name} is due, which is {format_local(due)}")


def _lines(course: Course, book: Book) -> Iterator[str]:
    extensions = due_dates.read_extensions(course)
    for name, when in book.due_dates().items():
        yield f"{name}: {format_local(when) if when else 'no due date'}"
        for student, until in sorted(extensions.get(name, {}).items()):
            yield f"  {student}: {format_local(until)}"
