"""The receipts of a class: of all marks on which gradebook and journal agree."""
import hmac
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from datetime import date

import nbformat
from nbformat import NotebookNode

from grader.exercise import Exercise
from grader.marking import secret
from grader.marking.errors import CourseError
from grader.marking.extras.receipts.receipt import MarkReceipt, ReceiptCell, seal_of
from grader.marking.gradebook.book import Book, GradebookMark
from grader.marking.gradebook.course import Course
from grader.marking.journal import Journal, JournalEntry
from grader.marking.judge.personal_release import drawn_numbers
from grader.marking.judge.testcells import exercise_names, find_exercise
from grader.marking.mark_evidence import fingerprint
from grader.marking.progress_line import printable
from grader.marking.version import LOCK
from grader.seeds import secret_of_student
from grader.variants import revealed_name

MAX_NAME_CHARS = 100
DIGESTS = ("submission", "release", LOCK)  # in the evidence; the rest are versions


@dataclass
class ClassReceipts:
    """The receipts by student and assignment, and a sentence for each mark that has none."""

    receipts: dict[str, list[MarkReceipt]] = field(default_factory=dict)
    doubts: list[str] = field(default_factory=list)


def make_receipts(course: Course, issuer: str, students: Collection[str], reveal: bool) -> ClassReceipts:
    """Receipts of all marks, or of those of these students. Raises CourseError, OSError."""
    with Book(course) as book:
        marks = [mark for mark in book.marks() if not students or mark.student in students]
    made, key = ClassReceipts(), secret.read(course.root)
    names = {mark.assignment for mark in marks}
    released = {name: list(_notebooks(course, name)) for name in names}
    for mark in sorted(marks, key=lambda mark: (mark.student, mark.assignment)):
        entry = Journal(course.journal(mark.assignment)).last(mark.student)
        doubt = _doubt(mark, entry, key)
        if entry is None or doubt:
            made.doubts.append(f"{mark.student}: {mark.assignment} {doubt}")
            continue
        receipt = sealed(_receipt(mark, entry, issuer), key, released[mark.assignment], reveal)
        made.receipts.setdefault(mark.student, []).append(receipt)
    return made


def receipt_of_one(
    mark: GradebookMark, entry: JournalEntry, issuer: str, key: str, notebooks: Iterable[NotebookNode]
) -> MarkReceipt:
    """The receipt of a mark that no gradebook has. notebooks: the release's. Raises CourseError."""
    if mark.needs_look:
        raise CourseError("there is no receipt of a mark that still needs a look")
    return sealed(_receipt(mark, entry, issuer), key, list(notebooks), reveal=False)


def sealed(receipt: MarkReceipt, key: str, notebooks: Sequence[NotebookNode], reveal: bool) -> MarkReceipt:
    """The receipt with the seal of its private seeds, if the class has a secret; with them if `reveal`.

    notebooks: the release's. The number of a variant, if there are variants, is sealed like a seed.
    """
    if not key:
        return receipt
    own = secret_of_student(key, receipt.student)
    nonce = hmac.new(own.encode(), f"receipt of {receipt.assignment}".encode(), "sha256").hexdigest()
    seeds = {name: [seed for _, seed in each.runs(own)] for name, each in _exercises(notebooks)}
    numbers = drawn_numbers(notebooks, own)
    seeds |= {revealed_name(name): [number] for name, number in numbers.items()}
    receipt = replace(receipt, seal=seal_of(nonce, seeds))
    return replace(receipt, nonce=nonce, seeds=seeds) if reveal else receipt


def _receipt(mark: GradebookMark, entry: JournalEntry, issuer: str) -> MarkReceipt:
    cells = (
        ReceiptCell(f"{note.name}/{cell.cell}", cell.exercise, cell.points, cell.max, tuple(cell.digests))
        for note in entry.result.notebooks
        for cell in note.cells
    )
    return MarkReceipt(
        student=mark.student,
        name=printable(mark.name)[:MAX_NAME_CHARS],
        assignment=mark.assignment,
        points=mark.points,
        most=mark.most,
        issuer=issuer,
        issued=date.today().isoformat(),
        cells=tuple(cells),
        digests={name: entry.evidence[name] for name in DIGESTS},
        versions={name: text for name, text in entry.evidence.items() if name not in (*DIGESTS, "secret")},
    )


def _doubt(mark: GradebookMark, entry: JournalEntry | None, key: str) -> str:
    """Return why a mark has no receipt, or ""."""
    if entry is None:
        return f"was not marked by `python -m grader mark {mark.assignment}`"
    again = f"mark {mark.assignment} again"
    if not entry.evidence:
        return f"was marked before there were receipts: {again}, with --force"
    if entry.evidence["secret"] != fingerprint(key):
        return f"was marked with a different secret from the one in .secret: {again}"
    earned = {(note.name, cell.cell): cell.points for note in entry.result.notebooks for cell in note.cells}
    if any(mark.by_marking.get(cell) != points for cell, points in earned.items()):
        return f"has different points in the gradebook from those that marking gave: {again}"
    return "still needs a look in the formgrader" if mark.needs_look else ""


def _notebooks(course: Course, assignment: str) -> Iterator[NotebookNode]:
    """The released notebooks of an assignment."""
    for path in sorted(course.release(assignment).glob("*.ipynb")):
        yield nbformat.read(path, 4)


def _exercises(notebooks: Iterable[NotebookNode]) -> Iterator[tuple[str, Exercise]]:
    """The exercises of an assignment's notebooks by name."""
    for notebook in notebooks:
        for name in filter(None, exercise_names(notebook).values()):
            found = find_exercise(name)
            yield found.name, found
