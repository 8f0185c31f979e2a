"""What each student wrote of an assignment: the cells and files that are not in the release."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.marking.errors import Unusable
from grader.marking.extras.likeness.syntax_grams import Grams, grams, is_python, python_of
from grader.marking.judge.marking_state import cell_name
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.rebuild import rebuild_submission
from grader.marking.submission.submitted_files import read_folder


@dataclass(frozen=True)
class WrittenPart:
    """A cell or a file: its name, and the text, if possible without the lines that the release has."""

    name: str
    text: str


@dataclass(frozen=True)
class StudentText:
    """The text that a student wrote. grams: of it, without those of the release."""

    student: str
    parts: tuple[WrittenPart, ...]
    grams: Grams

    @property
    def source(self) -> str:
        """All of it as one file of Python, in which each part has its name as a comment."""
        return "\n\n".join(f"# {part.name}\n{part.text}" for part in self.parts) + "\n"


def read_texts(submissions: Mapping[str, Path], release: Release) -> tuple[list[StudentText], dict[str, str]]:
    """The texts of these students, and why others have none, by student. Raises nothing."""
    given = [cell.source for note in release.notebooks.values() for cell in note.cells if _is_code(cell)]
    of_release, lines = grams(given), {line.strip() for source in given for line in source.splitlines()}
    found, problems = [], {}
    for student, folder in submissions.items():
        try:
            sources = list(_sources(folder, release, set(given)))
        except Unusable as reason:
            problems[student] = str(reason)
            continue
        parts = [WrittenPart(name, _without(text, lines)) for name, text in sources]
        written = tuple(part for part in parts if part.text.strip())
        found.append(StudentText(student, written, grams(text for _, text in sources) - of_release))
    return found, problems


def _sources(folder: Path, release: Release, given: set[str]) -> Iterator[tuple[str, str]]:
    """The names and texts of the cells that differ from the release's, and of Python files in a workspace."""
    submitted = read_folder(folder, release)
    for name, rebuilt in rebuild_submission(submitted, release).notebooks.items():
        for number, cell in enumerate(filter(_is_code, rebuilt.notebook.cells), 1):
            if cell.source.strip() and cell.source not in given:
                yield f"{name}: {cell_name(cell) or f'code cell {number}'}", cell.source
    if not isinstance(submitted.workspace, str):
        for path, data in submitted.workspace.items():
            if path.endswith(".py"):
                yield path, data.decode(errors="replace")


def _is_code(cell: Mapping[str, object]) -> bool:
    return cell["cell_type"] == "code"


def _without(text: str, lines: set[str]) -> str:
    """The text without lines of the release, except blank ones; all of it if the rest would be no Python."""
    kept = [line for line in text.splitlines() if not line.strip() or line.strip() not in lines]
    rest = python_of("\n".join(kept).strip("\n"))
    return rest if is_python(rest) else python_of(text)


def release_source(release: Release) -> str:
    """The cells of a release as one file of Python."""
    cells = [cell.source for note in release.notebooks.values() for cell in note.cells if _is_code(cell)]
    return "\n\n".join(filter(is_python, map(python_of, cells))) + "\n"
