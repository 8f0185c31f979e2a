"""`python -m grader grades` and `python -m grader collect`: their command lines."""
import argparse
import stat
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO

from grader.course_files.local_time import local_zone
from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.extras.learning_platform.collect import assignment_of
from grader.marking.extras.learning_platform.collect import collect as collect_archive
from grader.marking.extras.learning_platform.csv_file import CsvFile
from grader.marking.extras.learning_platform.feedback_zip import write_feedback_zip
from grader.marking.extras.learning_platform.fill_grades import FillReport, fill_grades, marks_of
from grader.marking.extras.learning_platform.grade_sheet import GradeSheet, read_canvas, read_moodle
from grader.marking.extras.learning_platform.known_students import known_students
from grader.marking.extras.learning_platform.worksheet_times import submission_times
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course
from grader.marking.progress_line import printable

GRADES = """Fill the marks of an assignment, or of all, into the file that the platform exported, in place.

Students are found by the platform's number, by user name or mail, and by name. Anyone who is not found is
listed, and no other column is changed. Import the file into the platform as it is."""
COLLECT = """Put the submissions that are in the platform's archive into class/submitted/. The newest upload
of each student counts, and everything that is not used is listed."""
TOTAL = "Course total"


def grades(arguments: list[str] | None = None) -> int:
    """Fill in grades in the course's folder; returns the exit status: 1 where a student is left out."""
    form = _grades_parser()
    options = form.parse_args(arguments)
    if bool(options.assignment) == options.total:
        form.error("expected the name of an assignment, or --total")
    if not (options.moodle or options.canvas or options.feedback_zip):
        form.error("expected --moodle FILE, --canvas FILE or --feedback-zip FILE")
    if options.feedback_zip and options.total:
        form.error("expected the name of an assignment with --feedback-zip")
    try:
        return _grades(options, Course(Path.cwd()))
    except CourseError as error:
        return _failed(f"Nothing was filled in: {error}")
    except OSError as error:
        return _failed(f"Stopped: {error.filename} can't be read or written ({error.strerror})")


def collect(arguments: list[str] | None = None) -> int:
    """Collect an archive in the course's folder; returns the exit status: 1 where a student is left out."""
    options = _collect_parser().parse_args(arguments)
    try:
        course = Course(Path.cwd())
        assignment = options.assignment or assignment_of(course, options.archive)
        sheet = _sheet(options, course, assignment)
        roster = {each.number: each for each in sheet.people.values()} if sheet else {}
        times = submission_times(sheet) if sheet and options.moodle else {}
        report = collect_archive(course, assignment, options.archive, roster, times)
    except CourseError as error:
        return _failed(f"Nothing was collected: {error}")
    except OSError as error:
        return _failed(f"Stopped: {error.filename} can't be read or written ({error.strerror})")
    counts = f"{len(report.new)} new, {len(report.replaced)} replaced, {len(report.unchanged)} unchanged"
    total = sum(map(len, (report.new, report.replaced, report.unchanged)))
    print(f"{assignment}: {total} submissions collected: {counts}.")
    if times:
        print(f"  Their times are those of {options.moodle}, read as local time ({local_zone()}).")
    _list(report.notes, sys.stdout)
    return _list(report.problems, sys.stderr)


def _grades(options: argparse.Namespace, course: Course) -> int:
    sheet = _sheet(options, course, options.assignment)
    report = FillReport()
    if sheet:
        report = _fill(options, course, sheet)
        people = sheet.people
    if options.feedback_zip:
        known = {report.students[at]: people[at] for at in report.students} if options.moodle else {}
        packed, problems = write_feedback_zip(course, options.assignment, options.feedback_zip, known)
        print(f"{options.feedback_zip}: the pages of {packed} students.")
        report.problems += problems
    return _list(report.problems, sys.stderr)


def _fill(options: argparse.Namespace, course: Course, sheet: GradeSheet) -> FillReport:
    """Fill the marks into the file, and report it."""
    if options.assignment and options.assignment not in course.assignments():
        known = ", ".join(course.assignments())
        raise CourseError(f"there is no assignment {options.assignment}: there are {known}")
    with Book(course) as book:
        marks, most = marks_of(book.marks(), options.assignment)
    what = options.assignment or "the class"
    if not marks or not most:
        mark = "run `python -m grader mark ASSIGNMENT` first"
        raise CourseError(f"the gradebook has no marks of {what}: {mark}")
    if sheet.most != most and not options.scale:
        raise CourseError(
            f"{what} has {most:g} points, and {sheet.most:g} in {sheet.file.path}: "
            f"set {most:g} on the platform and export again, or convert the points with --scale"
        )
    report = fill_grades(sheet, marks, most, known_students(course, options.assignment))
    path = sheet.file.path
    write_atomically(path, sheet.file.to_bytes(), stat.S_IMODE(path.stat().st_mode))
    print(f"{path}: {report.filled} grades filled in, in the column {sheet.file.header[sheet.column]!r}.")
    _list(report.replaced, sys.stdout)
    return report


def _sheet(options: argparse.Namespace, course: Course, assignment: str) -> GradeSheet | None:
    if options.moodle:
        return read_moodle(CsvFile(options.moodle), options.column, options.decimal)
    if options.canvas:
        titles = [assignment or TOTAL]
        return read_canvas(CsvFile(options.canvas), options.column, titles, options.decimal)
    return None


def _list(sentences: Iterable[str], stream: TextIO) -> int:
    """Print the sentences; return 1 if there are any."""
    lines = [printable(sentence) for sentence in sentences]
    for line in lines:
        print(f"  {line}.", file=stream)
    return int(bool(lines))


def _failed(text: str) -> int:
    print(text if text.endswith(("?", ".")) else f"{text}.", file=sys.stderr)
    return 1


def _add_sheets(made: argparse.ArgumentParser) -> None:
    add = made.add_mutually_exclusive_group().add_argument
    add("--moodle", type=Path, metavar="FILE", help="the grading worksheet of the assignment")
    add("--canvas", type=Path, metavar="FILE", help="the export of the gradebook")
    column = "the title of the grades' column, with or without Canvas's number"
    made.add_argument("--column", default="", metavar="TITLE", help=column)
    decimal = "the decimal mark, if no number in the file shows it"
    made.add_argument("--decimal", choices=(".", ","), default="", help=decimal)


def _grades_parser() -> argparse.ArgumentParser:
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader grades", description=GRADES, formatter_class=form)
    made.add_argument("assignment", nargs="?", default="", metavar="ASSIGNMENT")
    made.add_argument("--total", action="store_true", help="the sum of all assignments that are marked")
    _add_sheets(made)
    made.add_argument("--scale", action="store_true", help="convert the points to the platform's maximum")
    feedback = "pack the students' pages in the form that the platform imports"
    made.add_argument("--feedback-zip", type=Path, metavar="FILE", help=feedback)
    return made


def _collect_parser() -> argparse.ArgumentParser:
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader collect", description=COLLECT, formatter_class=form)
    made.add_argument("archive", type=Path, metavar="ARCHIVE.zip")
    named = "default: the one whose notebooks are in the archive"
    made.add_argument("--assignment", default="", metavar="NAME", help=named)
    _add_sheets(made)
    return made
