"""Compares a receipt with a submission and a release, and with the result of marking them again."""
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path

from grader.marking import secret
from grader.marking.errors import NotConfirmed
from grader.marking.extras.receipts.receipt import MarkReceipt
from grader.marking.mark_evidence import evidence
from grader.marking.result import Result
from grader.marking.submission.assignment_release import load_release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask, TaskPool
from grader.marking.version import LOCK
from grader.page import format_points
from grader.seeds import revealed_seeds

OpenSeededPool = Callable[[str], AbstractContextManager[TaskPool]]  # from a secret


def check_submission(receipt: MarkReceipt, submission: Path, release: Path) -> MarkingTask:
    """The task of marking the submission again. Raises NotConfirmed unless both are those of the receipt."""
    released = load_release(release)
    task = MarkingTask(receipt.student, released, read_folder(submission, released), "0" * 64)
    here = evidence(task, "")
    for what, path in (("release", release), ("submission", submission)):
        if here[what] != receipt.digests.get(what):
            raise NotConfirmed(f"{path} is not the {what} that was marked: its digest differs")
    return task


def other_versions(receipt: MarkReceipt, task: MarkingTask) -> Iterator[str]:
    """A sentence for everything that is another one here than when the mark was given."""
    here = evidence(task, "")
    if here[LOCK] != receipt.digests.get(LOCK):
        yield f"{LOCK} is different here"
    for name, version in receipt.versions.items():
        if here.get(name) != version:
            yield f"{name} is {here.get(name)} here, and was {version}"


def secret_for(receipt: MarkReceipt, folder: Path) -> str:
    """A secret that gives the worlds of the receipt. Raises NotConfirmed if there is none."""
    if not receipt.seal:
        return ""
    if receipt.seeds:
        return revealed_seeds(receipt.seeds)
    found = secret.read(folder)
    if not found:
        raise NotConfirmed(
            "the seeds of its worlds are sealed, so it can't be marked again here: "
            "the instructor reveals them with `python -m grader receipts --reveal`"
        )
    return found


def differences(receipt: MarkReceipt, result: Result) -> Iterator[str]:
    """A sentence for each test cell that has other points, or another recording, than in the receipt."""
    if result.reason:
        yield f"it was {result.verdict}: {result.reason.rstrip('.')}"
    now = {f"{note.name}/{cell.cell}": cell for note in result.notebooks for cell in note.cells}
    for cell in receipt.cells:
        found = now.get(cell.cell)
        had = f"and {format_points(cell.points)} in the receipt"
        if found is None:
            yield f"{cell.cell} has no points now, {had}"
        elif found.points != cell.points:
            yield f"{cell.cell} has {format_points(found.points)} points now, {had}"
        elif tuple(found.digests) != cell.recordings:
            yield f"{cell.cell} has the same points, from other recordings"
