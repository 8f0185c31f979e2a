"""`python -m grader certificate` and `python -m grader confirm`: their command lines."""
import argparse
import re
import sys
from collections.abc import Iterator
from datetime import date
from pathlib import Path

from grader.marking import secret
from grader.marking.atomic_file import write_atomically
from grader.marking.certificate.certificate import Certificate
from grader.marking.certificate.confirm import Now, confirm_number, confirm_page, quoted
from grader.marking.certificate.marks import Standing, read_standings
from grader.marking.certificate.receipt import FILE, Receipt
from grader.marking.errors import CourseError, NotConfirmed
from grader.marking.gradebook.course import Course
from grader.marking.progress_line import printable
from grader.marking.version import versions

CERTIFICATE = """Write a page for each student that says which assignments were passed:
class/certificates/STUDENT.html. What was certified is kept, sealed with your secret, in
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
        standings = read_standings(course, options.student)
        for student in options.student:
            if student not in standings:
                raise CourseError(f"the gradebook has no mark of {quoted(student)}")
        if not standings:
            raise CourseError("the gradebook has no marks: run `python -m grader mark ASSIGNMENT` first")
        made = list(_certificates(course, standings, options))
        pages = {each.student: receipt.enter(each) for each in made}
        receipt.write()  # before the pages: none is without its line
        _write_pages(course, standings, pages)
    except CourseError as error:
        return _failed(f"No certificates: {error}")
    except OSError as error:
        return _failed(f"Stopped: {error.filename or 'a file'} could not be written ({error.strerror})")
    return _tell(standings, {each.student: each for each in made}, receipt)


def confirm(arguments: list[str] | None = None) -> int:
    """Confirm a page or a number; returns the exit status: 0 where all agrees."""
    options = _confirm_parser().parse_args(arguments)
    try:
        receipt, now = _kept(options.kept)
        if NUMBER.fullmatch(options.page):
            said = confirm_number(options.page, receipt, now)
        else:
            said = confirm_page(_read(Path(options.page)), receipt, now)
    except (CourseError, NotConfirmed) as error:
        return _failed(f"Not confirmed: {error}")
    print(f"Confirmed: {said}.")
    return 0


def _certificates(
    course: Course, standings: dict[str, Standing], options: argparse.Namespace
) -> Iterator[Certificate]:
    """One for each student who passed something."""
    version, count = versions()["course"], len(course.assignments())
    for student, standing in standings.items():
        marks = standing.marks.values()
        passed = [mark for mark in marks if 100 * mark.points >= options.least * mark.most > 0]
        if passed:
            yield Certificate(
                student=student,
                name=standing.name,
                issuer=options.issuer.strip(),
                version=version,
                issued=date.today().isoformat(),
                least=options.least,
                assignments=count,
                marks=tuple(passed),
            )


def _write_pages(
    course: Course, standings: dict[str, Standing], pages: dict[str, tuple[str, str]]
) -> None:
    """Write the pages, and take away those of students who have passed nothing any more."""
    for student, standing in standings.items():
        if student in pages:
            write_atomically(course.certificates() / f"{student}.html", pages[student][1])
        elif standing.marks:  # then the id is the name of a file
            (course.certificates() / f"{student}.html").unlink(missing_ok=True)


def _tell(standings: dict[str, Standing], made: dict[str, Certificate], receipt: Receipt) -> int:
    for student in standings:
        words = made[student].shown()["number of assignments"] if student in made else ""
        print(printable(f"{student}: {words} passed" if words else f"{student}: none passed, no page"))
    left_out = [(student, *doubt) for student, each in standings.items() for doubt in each.doubts.items()]
    for student, assignment, doubt in left_out:
        print(printable(f"{student}: {assignment} {doubt}. It is left out."), file=sys.stderr)
    kept = f"Keep {FILE} there, and .secret, as long as you want to confirm them."
    print(f"{len(made)} certificates in {receipt.file.parent}. {kept}")
    return int(bool(left_out))


def _secret(folder: Path) -> str:
    found = secret.read(folder)
    if not found:
        raise CourseError(f"certificates need your secret, and there is no .secret in {folder}")
    return found


def _kept(folder: str) -> tuple[Receipt, Now | None]:
    """The receipt, and who knows the marks as they are now: nobody where the class is over."""
    if folder:
        place, key, now = Path(folder), _secret(Path(folder)), None
    else:
        course = Course(Path.cwd())
        place, key = course.certificates(), _secret(course.root)

        def now(student: str) -> Standing:
            return read_standings(course, [student]).get(student, Standing(student))

    if not (place / FILE).exists():
        raise CourseError(f"there is no {FILE} in {place}: nothing was issued, or it lies elsewhere")
    return Receipt(place, key), now


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        expected = "expected a page, or a number such as 0a1b-2c3d-4e5f-6789"
        raise NotConfirmed(f"{expected}, saw {quoted(str(path))} ({error.strerror})") from None


def _failed(said: str) -> int:
    print(f"{said}.", file=sys.stderr)
    return 1


def _certificate_parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser("python -m grader certificate", description=CERTIFICATE)
    add = made.add_argument
    who = "who issues them, and how you are reached: who sees a page asks you"
    add("--issuer", required=True, type=_words, metavar="WORDS", help=who)
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


def _words(words: str) -> str:
    if not words.strip():
        raise argparse.ArgumentTypeError("expected your name and address, saw nothing")
    return printable(words)


def _percent(word: str) -> float:
    try:
        share = float(word)
    except ValueError:
        share = 0.0
    if not 0 < share <= 100:
        raise argparse.ArgumentTypeError(f"expected a number above 0, at most 100, saw {word!r}")
    return share
