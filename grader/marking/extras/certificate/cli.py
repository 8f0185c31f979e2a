"""`python -m grader certificate` and `python -m grader confirm`: their command lines."""
import argparse
import re
import sys
from collections.abc import Iterator
from datetime import date
from pathlib import Path

from grader.marking import secret
from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, NotConfirmed
from grader.marking.extras.certificate.certificate import Certificate
from grader.marking.extras.certificate.confirm import CurrentMarks, confirm_number, confirm_page, quote_text
from grader.marking.extras.certificate.receipt import FILE, Receipt
from grader.marking.extras.certificate.student_marks import StudentMarks, read_marks
from grader.marking.gradebook.course import Course
from grader.marking.progress_line import printable
from grader.marking.version import versions

CERTIFICATE = """Write a page for each student that says which assignments were passed:
class/certificates/STUDENT.html. What was certified is stored, sealed with your secret, in
class/certificates/receipt.json; `python -m grader confirm` compares a page with it."""
CONFIRM = """Say in one sentence whether a certificate is genuine: a page is compared with the receipt,
and with the marks as they are now. Of a printed page give the number."""
NUMBER = re.compile(r"[0-9a-f]{4}(-[0-9a-f]{4}){3}")


def certificate(arguments: list[str] | None = None) -> int:
    """Write certificates in the course's folder; returns the exit status: 1 where a mark is left out."""
    options = _certificate_parser().parse_args(arguments)
    try:
        course = Course(Path.cwd())
        receipt = Receipt(course.certificates(), _secret(course.root))
        records = read_marks(course, options.student)
        for student in options.student:
            if student not in records:
                raise CourseError(f"the gradebook has no mark of {quote_text(student)}")
        if not records:
            raise CourseError("the gradebook has no marks: run `python -m grader mark ASSIGNMENT` first")
        made = list(_certificates(course, records, options))
        pages = {each.student: receipt.enter(each) for each in made}
        receipt.write()  # before the pages: none is without its line
        _write_pages(course, records, pages)
    except CourseError as error:
        return _failed(f"No certificates: {error}")
    except OSError as error:
        return _failed(f"Stopped: {error.filename or 'a file'} could not be written ({error.strerror})")
    return _report(records, {each.student: each for each in made}, receipt)


def confirm(arguments: list[str] | None = None) -> int:
    """Confirm a page or a number; returns the exit status: 0 where all agrees."""
    options = _confirm_parser().parse_args(arguments)
    try:
        receipt, now = _receipt(options.kept)
        if NUMBER.fullmatch(options.page):
            sentence = confirm_number(options.page, receipt, now)
        else:
            sentence = confirm_page(_read(Path(options.page)), receipt, now)
    except (CourseError, NotConfirmed) as error:
        return _failed(f"Not confirmed: {error}")
    print(f"Confirmed: {sentence}.")
    return 0


def _certificates(
    course: Course, records: dict[str, StudentMarks], options: argparse.Namespace
) -> Iterator[Certificate]:
    """A certificate for each student who passed an assignment."""
    version, count = versions()["course"], len(course.assignments())
    for student, record in records.items():
        marks = record.marks.values()
        passed = [mark for mark in marks if 100 * mark.points >= options.least * mark.most > 0]
        if passed:
            yield Certificate(
                student=student,
                name=record.name,
                issuer=options.issuer.strip(),
                version=version,
                issued=date.today().isoformat(),
                least=options.least,
                assignments=count,
                marks=tuple(passed),
            )


def _write_pages(
    course: Course, records: dict[str, StudentMarks], pages: dict[str, tuple[str, str]]
) -> None:
    """Write the pages, and remove those of students who have passed nothing any more."""
    for student, record in records.items():
        if student in pages:
            write_atomically(course.certificates() / f"{student}.html", pages[student][1])
        elif record.marks:  # then the id is the name of a file
            (course.certificates() / f"{student}.html").unlink(missing_ok=True)


def _report(records: dict[str, StudentMarks], made: dict[str, Certificate], receipt: Receipt) -> int:
    for student in records:
        count = made[student].fields()["number of assignments"] if student in made else ""
        print(printable(f"{student}: {count} passed" if count else f"{student}: none passed, no page"))
    left_out = [(student, *doubt) for student, each in records.items() for doubt in each.doubts.items()]
    for student, assignment, doubt in left_out:
        print(printable(f"{student}: {assignment} {doubt}. It is left out."), file=sys.stderr)
    advice = f"Keep {FILE} there, and .secret, as long as you want to confirm them."
    print(f"{len(made)} certificates in {receipt.file.parent}. {advice}")
    return int(bool(left_out))


def _secret(folder: Path) -> str:
    found = secret.read(folder)
    if not found:
        raise CourseError(f"certificates need your secret, and there is no .secret in {folder}")
    return found


def _receipt(folder: str) -> tuple[Receipt, CurrentMarks | None]:
    """The receipt, and a function for the current marks: None if the class is over."""
    if folder:
        place, key, now = Path(folder), _secret(Path(folder)), None
    else:
        course = Course(Path.cwd())
        place, key = course.certificates(), _secret(course.root)

        def now(student: str) -> StudentMarks:
            return read_marks(course, [student]).get(student, StudentMarks(student))

    if not (place / FILE).exists():
        raise CourseError(f"there is no {FILE} in {place}: nothing was issued, or it is elsewhere")
    return Receipt(place, key), now


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        expected = "expected a page, or a number such as 0a1b-2c3d-4e5f-6789"
        raise NotConfirmed(f"{expected}, saw {quote_text(str(path))} ({error.strerror})") from None


def _failed(text: str) -> int:
    print(f"{text}.", file=sys.stderr)
    return 1


def _certificate_parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser("python -m grader certificate", description=CERTIFICATE)
    add = made.add_argument
    who = "your name and contact, for anyone who wants a certificate confirmed"
    add("--issuer", required=True, type=_text, metavar="TEXT", help=who)
    share = "percent of an assignment's points that pass; default: 50"
    add("--pass", dest="least", type=_percent, default=50.0, metavar="PERCENT", help=share)
    add("--student", action="append", default=[], metavar="NAME", help="only this one; may be given again")
    return made


def _confirm_parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser("python -m grader confirm", description=CONFIRM)
    made.add_argument("page", metavar="PAGE", help="the file, or the number on a printed page")
    where = f"the folder with {FILE} and .secret of a class that is over; its marks are not looked at"
    made.add_argument("--kept", default="", metavar="FOLDER", help=where)
    return made


def _text(text: str) -> str:
    if not text.strip():
        raise argparse.ArgumentTypeError("expected your name and address, saw nothing")
    return printable(text)


def _percent(word: str) -> float:
    try:
        share = float(word)
    except ValueError:
        share = 0.0
    if not 0 < share <= 100:
        raise argparse.ArgumentTypeError(f"expected a number above 0, at most 100, saw {word!r}")
    return share
