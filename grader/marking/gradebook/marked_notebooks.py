"""Writes the notebooks of marked submissions into class/autograded/, for formgrader and feedback."""
import copy
from collections.abc import Iterable
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from grader.marking.atomic_file import write_atomically
from grader.marking.gradebook.course import SUBMISSION_SECRET, TIMESTAMP, Course, small_text
from grader.marking.journal import JournalEntry
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release

NOTICE = "how-this-was-marked"  # id of the cell on top
MARKING = "marking"  # metadata: the id of the marking that a notebook shows
OPENINGS = {
    "marked": "",
    "repaired": "Your notebook was repaired before it was marked. Please check that this is your work:",
    "stopped": "Your notebook stopped. A cell in which it stopped earns nothing; the others count.",
    "refused": "Your submission could not be marked.",
}


def marked_notebooks(entry: JournalEntry, release: Release) -> dict[str, NotebookNode]:
    """The notebooks to show, by name. For a refused submission, those of the release."""
    shown = {note.name: nbformat.from_dict(note.notebook) for note in entry.result.notebooks}
    if not shown:
        shown = copy.deepcopy(dict(release.notebooks))
    words = notice(entry.result)
    for notebook in shown.values():
        notebook.metadata[MARKING] = entry.id
        if words:
            notebook.cells.insert(0, nbformat.v4.new_markdown_cell(words, id=NOTICE))
    return shown


def notice(result: Result) -> str:
    """The notice for the student about the marking itself, as Markdown; "" if all was as usual."""
    opening = OPENINGS[result.verdict] or (OPENINGS["repaired"] if result.repairs else "")
    if not opening:
        return ""
    parts = ["**How this was marked**", opening, *([_line(result.reason)] if result.reason else [])]
    if result.repairs and opening != OPENINGS["repaired"]:
        parts.append("It was repaired first:")
    return "\n\n".join([*parts, "\n".join(f"- {_line(repair)}" for repair in result.repairs)]).rstrip()


def write_notebooks(course: Course, result: Result, shown: dict[str, NotebookNode], time: str) -> None:
    """Write the notebooks into the student's folder. Raises OSError.

    time: the text of the submission's timestamp.txt, or "".
    """
    student, assignment = result.student, result.assignment
    folder = course.autograded(student, assignment)
    mode = 0o664 if course.directory.groupshared else 0o444
    secret = small_text(course.submitted(student, assignment), SUBMISSION_SECRET)
    for name, text in ((TIMESTAMP, time), (SUBMISSION_SECRET, secret)):
        if text:
            write_atomically(folder / name, text, mode)
        else:
            (folder / name).unlink(missing_ok=True)
    for old in folder.glob("*.ipynb"):
        if old.stem not in shown:
            old.unlink()
    for name, notebook in shown.items():
        write_atomically(folder / f"{name}.ipynb", nbformat.writes(notebook) + "\n", mode)


def is_shown(course: Course, entry: JournalEntry, names: Iterable[str]) -> bool:
    """Return whether the notebooks in the student's folder are those of this marking."""
    folder = course.autograded(entry.result.student, entry.result.assignment)
    submitted = course.submitted(entry.result.student, entry.result.assignment)
    same = small_text(submitted, SUBMISSION_SECRET) == small_text(folder, SUBMISSION_SECRET)
    return same and all(_marking(folder / f"{name}.ipynb") == entry.id for name in names)


def _marking(path: Path) -> object:
    try:
        return nbformat.read(path, nbformat.NO_CONVERT).metadata.get(MARKING)
    except (OSError, ValueError, AttributeError):
        return None


def _line(words: str) -> str:
    return " ".join(words.split())
