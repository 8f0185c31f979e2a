"""Compares a certificate with the receipt, and with the current marks."""
from collections.abc import Callable

from grader.marking.errors import NotConfirmed
from grader.marking.extras.certificate.certificate import Certificate, format_day, format_score
from grader.marking.extras.certificate.certificate_page import NUMBER, read_page
from grader.marking.extras.certificate.receipt import IssuedCertificate, Receipt
from grader.marking.extras.certificate.student_marks import StudentMarks
from grader.marking.progress_line import printable

CurrentMarks = Callable[[str], StudentMarks]  # of a student
MAX_QUOTE_CHARS = 80  # of untrusted text


def confirm_page(page: str, receipt: Receipt, now: CurrentMarks | None = None) -> str:
    """Confirm a page; returns a sentence without a full stop. now: the current marks, if available.

    Raises NotConfirmed with what does not agree.
    """
    fields = read_page(page)
    number = fields.pop(NUMBER, "")
    if not number:
        raise NotConfirmed("this is not a certificate of this course: it has no number")
    issued = receipt.find(printable(number))
    _compare(fields, issued.certificate.fields())
    if receipt.seal_of_page(page) != issued.page:
        what = "name and marks agree, but something else on the page was changed"
        raise NotConfirmed(f"{what}: ask for the file as it was issued")
    return _confirmed(number, issued, now)


def confirm_number(number: str, receipt: Receipt, now: CurrentMarks | None = None) -> str:
    """The same for the number on a printed page, with the marks for the reader to compare."""
    issued = receipt.find(number)
    marks = "; ".join(f"{mark.title}: {format_score(mark)}" for mark in issued.certificate.marks)
    return f"{_confirmed(number, issued, now)}. Compare with the page: {marks}"


def _compare(seen: dict[str, str], issued: dict[str, str]) -> None:
    """Raise NotConfirmed with the first thing on the page that is not what was issued."""
    for what, text in issued.items():
        if what not in seen:
            raise NotConfirmed(f"the page lacks the {what}, which was {quote_text(text)} when it was issued")
        if seen[what] != text:
            was = f"and was {quote_text(text)} when it was issued"
            raise NotConfirmed(f"the {what} is {quote_text(seen[what])} on the page, {was}")
    for what in seen:
        if what not in issued:
            raise NotConfirmed(f"the page has a {printable(what)}, which was not there when it was issued")


def _confirmed(number: str, issued: IssuedCertificate, now: CurrentMarks | None) -> str:
    certificate = issued.certificate
    again = _changes(certificate, now(certificate.student)) if now else []
    who = f"{quote_text(certificate.name)} ({quote_text(certificate.student)})"
    passed = f"{certificate.fields()['number of assignments']} assignments passed"
    rest = f"; marked again since, with the same points: {', '.join(again)}" if again else ""
    return f"number {number} was issued to {who} on {format_day(certificate.issued)}, {passed}{rest}"


def _changes(certificate: Certificate, record: StudentMarks) -> list[str]:
    """The assignments with another result and the same points. Raises NotConfirmed for other points."""
    again = []
    for mark in certificate.marks:
        had = f"{mark.assignment} had {format_score(mark)} points on {format_day(certificate.issued)}"
        if doubt := record.doubts.get(mark.assignment):
            raise NotConfirmed(f"{had}, and now it {doubt}")
        held = record.marks.get(mark.assignment)
        if held is None:
            raise NotConfirmed(f"{had}, and now the gradebook has no mark")
        if (held.points, held.most) != (mark.points, mark.most):
            raise NotConfirmed(f"{had}, and has {format_score(held)} now: the mark was changed since")
        if held.digest != mark.digest:
            again.append(mark.assignment)
    return again


def quote_text(text: str) -> str:
    """Untrusted text, quoted for a sentence on a terminal."""
    plain = printable(text)
    return f"“{plain if len(plain) <= MAX_QUOTE_CHARS else plain[: MAX_QUOTE_CHARS - 1] + '…'}”"
