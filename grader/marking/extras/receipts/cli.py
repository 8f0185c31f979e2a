"""`python -m grader receipts` and `python -m grader verify`: their command lines."""
import argparse
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, NotConfirmed, SandboxFailed, SandboxMissing
from grader.marking.extras.receipts import check_receipt, envelope
from grader.marking.extras.receipts.certificate_page import as_page, check_page, sentence, signed_in
from grader.marking.extras.receipts.check_receipt import OpenSeededPool
from grader.marking.extras.receipts.issue import make_receipts
from grader.marking.extras.receipts.receipt import MarkReceipt
from grader.marking.gradebook.course import Course
from grader.marking.pool import Pool
from grader.marking.progress_line import printable

RECEIPTS = """Sign a receipt for every mark, class/receipts/STUDENT/ASSIGNMENT.json, and a certificate for
each student who passed something, class/receipts/STUDENT.html: a page of the receipts. The key is made the
first time; give class/receipts/public.pem to everyone who wants to confirm a mark."""
VERIFY = """Confirm a receipt or a certificate with the instructor's public key, and show what it certifies.
With the submission and the release, check that the mark was given for them, and mark again."""
KEY = Path("class", "receipts", envelope.PUBLIC)
LIBRARY = "receipts need the library securesystemslib: run `make tools`"


def receipts(arguments: list[str] | None = None) -> int:
    """Write receipts in the course's folder; returns the exit status: 1 where a mark has none."""
    options = _receipts_parser().parse_args(arguments)
    try:
        if not find_spec("securesystemslib"):
            raise CourseError(LIBRARY)
        course = Course(Path.cwd())
        made = make_receipts(course, options.issuer, options.student, options.reveal)
        if not made.receipts and not made.doubts:
            raise CourseError("the gradebook has no marks: run `python -m grader mark ASSIGNMENT` first")
        folder = course.receipts()
        signer = envelope.make_keys(course.root / envelope.PRIVATE, folder / envelope.PUBLIC)
        for student, each in made.receipts.items():
            _write(folder, student, each, signer, options.least)
    except CourseError as error:
        return _failed(f"No receipts: {error}")
    except OSError as error:
        return _failed(f"Stopped: {error.filename or 'a file'} could not be written ({error.strerror})")
    count = sum(map(len, made.receipts.values()))
    print(f"{count} receipts in {folder}. Keep {envelope.PRIVATE} to yourself, and a copy of it.")
    for doubt in made.doubts:
        print(printable(f"{doubt}. It has no receipt."), file=sys.stderr)
    return int(bool(made.doubts))


def _write(folder: Path, student: str, made: list[MarkReceipt], signer: Any, least: float) -> None:
    """Write a student's receipts, and the page of those that passed. What is unchanged keeps its date."""
    signed: dict[str, tuple[MarkReceipt, str]] = {}
    for receipt in made:
        file = folder / student / f"{receipt.assignment}.json"
        receipt = _with_old_date(receipt, file, signer)
        text = envelope.sign(receipt.statement(), signer)
        write_atomically(file, text)
        if 100 * receipt.points >= least * receipt.most > 0:
            signed[receipt.assignment] = receipt, text
    page = folder / f"{student}.html"
    if signed:
        write_atomically(page, as_page(*zip(*signed.values(), strict=True)))
    else:
        page.unlink(missing_ok=True)


def _with_old_date(receipt: MarkReceipt, file: Path, signer: Any) -> MarkReceipt:
    try:
        signed = file.read_text(encoding="utf-8")
        old = MarkReceipt.from_statement(envelope.open_signed(signed, signer.public_key))
    except (OSError, ValueError, NotConfirmed):
        return receipt
    dated = replace(receipt, issued=old.issued)
    return dated if dated == old else receipt


def verify(arguments: list[str] | None = None, open_pool: OpenSeededPool | None = None) -> int:
    """Confirm a receipt or a page; returns the exit status: 0 where all agrees."""
    form = _verify_parser()
    options = form.parse_args(arguments)
    if (options.submission is None) != (options.release is None):
        form.error("expected --submission FOLDER and --release FOLDER together")
    try:
        if not find_spec("securesystemslib"):
            raise NotConfirmed(LIBRARY)
        confirmed = _confirmed(options.receipt, envelope.read_key(options.key))
        for receipt in confirmed:
            print(printable(f"Confirmed: {sentence(receipt)}."))
        if options.submission is None:
            return 0
        if len(confirmed) != 1:
            raise NotConfirmed("expected one receipt to mark again, saw a page of several")
        return _mark_again(options, confirmed[0], open_pool)
    except (NotConfirmed, CourseError, SandboxMissing, SandboxFailed) as error:
        return _failed(f"Not confirmed: {error}")


def _confirmed(path: Path, key: Any) -> list[MarkReceipt]:
    """The receipts in a file. Raises NotConfirmed."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", "it is not text")
        raise NotConfirmed(f"expected a receipt, saw {path} ({why})") from None
    if text.lstrip().startswith("<"):
        found = [MarkReceipt.from_statement(envelope.open_signed(each, key)) for each in signed_in(text)]
        check_page(text, found)
        return found
    return [MarkReceipt.from_statement(envelope.open_signed(text, key))]


def _mark_again(options: argparse.Namespace, receipt: MarkReceipt, open_pool: OpenSeededPool | None) -> int:
    task = check_receipt.check_submission(receipt, options.submission, options.release)
    print("Submission and release are those that were marked.")
    for other in check_receipt.other_versions(receipt, task):
        print(printable(f"{other}: points may differ."))
    key = check_receipt.secret_for(receipt, Path.cwd())
    with open_pool(key) if open_pool else Pool(1, options.unsafe, key) as pool:
        (result,) = pool.mark([task])
    found = list(check_receipt.differences(receipt, result))
    if found:
        return _failed("\n".join(["Marked again, with differences:", *(f"  {each}" for each in found)]))
    points = sum(cell.points for cell in receipt.cells)
    print(f"Marked again, with equal points and recordings: {points:g} in {len(receipt.cells)} test cells.")
    return 0


def _failed(text: str) -> int:
    print("\n".join(map(printable, text.splitlines())) + ".", file=sys.stderr)
    return 1


def _receipts_parser() -> argparse.ArgumentParser:
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader receipts", description=RECEIPTS, formatter_class=form)
    add = made.add_argument
    add("--issuer", required=True, type=printable, metavar="TEXT", help="your name and contact")
    share = "percent of an assignment's points that are on the certificate; default: 50"
    add("--pass", dest="least", type=_percent, default=50.0, metavar="PERCENT", help=share)
    add("--student", action="append", default=[], metavar="NAME", help="only this one; may be given again")
    reveal = "with the seeds of the private worlds, so that others can mark again"
    add("--reveal", action="store_true", help=reveal)
    return made


def _verify_parser() -> argparse.ArgumentParser:
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader verify", description=VERIFY, formatter_class=form)
    add = made.add_argument
    add("receipt", type=Path, metavar="RECEIPT", help="a receipt, or the page of a certificate")
    add("--key", type=Path, default=KEY, metavar="FILE", help=f"the instructor's public key; default: {KEY}")
    add("--submission", type=Path, metavar="FOLDER", help="the folder that the student handed in")
    add("--release", type=Path, metavar="FOLDER", help="the assignment, such as exercises/01_nodes")
    add("--unsafe", action="store_true", help="no sandbox: the student's code can do anything that you can")
    return made


def _percent(word: str) -> float:
    try:
        share = float(word)
    except ValueError:
        share = 0.0
    if not 0 < share <= 100:
        raise argparse.ArgumentTypeError(f"expected a number above 0, at most 100, saw {word!r}")
    return share
