"""Signs a receipt for one mark that no gradebook has."""
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.extras.one_submission.judge_one import Judged
from grader.marking.extras.receipts import envelope
from grader.marking.extras.receipts.issue import receipt_of_one
from grader.marking.gradebook.gradebook_rows import GradebookMark
from grader.marking.journal import JournalEntry


def require_library() -> None:
    """Raise CourseError unless receipts can be signed here."""
    if not find_spec("securesystemslib"):
        raise CourseError("receipts need the library securesystemslib: run `make tools`")


def write_receipt(judged: Judged, data: dict[str, Any], issuer: str, key: str, to: Path) -> None:
    """Write the receipt of a mark, signed with .signing-key of this folder, and public.pem next to it.

    data: the mark's report. key: the class's secret. Raises CourseError, OSError.
    """
    result = judged.result
    cells = {(note.name, cell.cell): cell.points for note in result.notebooks for cell in note.cells}
    mark = GradebookMark(
        student=result.student,
        name=result.student,
        assignment=result.assignment,
        points=data["points_after_lateness"],
        most=data["max_points"],
        by_marking=dict(cells),
        needs_look=data["needs_look"] or data["points_by_hand"] > 0,
        penalty=data["late"]["penalty"] if data["late"] else 0.0,
    )
    entry = JournalEntry("", result, judged.evidence)
    receipt = receipt_of_one(mark, entry, issuer, key, judged.release.notebooks.values())
    signer = envelope.make_keys(Path(envelope.PRIVATE), to.with_name(envelope.PUBLIC))
    write_atomically(to, envelope.sign(receipt.statement(), signer))
