"""Stores the results of marking, before and after they are in the gradebook.

Each is a file class/marking/ASSIGNMENT/STUDENT.json. A result is stored before anything else is done with it,
so a run that is killed loses only the submissions that were being marked.
"""
import contextlib
import fcntl
import hashlib
import json
import os
import uuid
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, ResultError
from grader.marking.result import Result
from grader.marking.task import MarkingTask

SETTINGS = ".settings.json"  # hidden: no student's name begins with a dot
LOCK = ".lock"
PAGES = ".pages.json"


@dataclass(frozen=True)
class JournalEntry:
    """A result in the journal. `id` identifies this marking: the notebooks made from it have it, too.

    evidence: what the mark was given for; see `grader.marking.mark_evidence`.
    """

    id: str
    result: Result
    evidence: dict[str, str] = field(default_factory=dict)


class Journal:
    """The results of one assignment in a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @contextlib.contextmanager
    def hold_lock(self) -> Iterator[None]:
        """Hold the journal while marking. Raises CourseError where another process does."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with open(self.folder / LOCK, "a+") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                file.seek(0)
                other = f"process {file.read().strip()} is already marking {self.folder.name}"
                raise CourseError(f"{other}: wait for it, or stop it with Ctrl-C") from None
            file.truncate(0)
            file.write(str(os.getpid()))
            file.flush()
            yield

    def save(self, result: Result, evidence: dict[str, str] | None = None) -> JournalEntry:
        """Store a result in place of the student's last one. Raises OSError."""
        entry = JournalEntry(uuid.uuid4().hex, result, evidence or {})
        body = result.to_json()
        head = json.dumps({"id": entry.id, "sha256": _digest(body), "evidence": entry.evidence})
        write_atomically(self._file(result.student), f"{head}\n{body}\n", mode=0o600)
        return entry

    def find(self, student: str, key: str) -> JournalEntry | None:
        """The result of a student's submission with this key, or None if no valid one is stored."""
        entry = self.last(student)
        return entry if entry and entry.result.key == key else None

    def last(self, student: str) -> JournalEntry | None:
        """A student's last result, or None if no valid one is stored."""
        try:
            head, body = self._file(student).read_text(encoding="utf-8").rstrip("\n").split("\n", 1)
            known = json.loads(head)
            if known["sha256"] != _digest(body):
                return None
            entry = JournalEntry(str(known["id"]), Result.from_json(body), known.get("evidence", {}))
        except (OSError, ValueError, KeyError, TypeError, ResultError):
            return None
        result = entry.result
        return entry if (result.student, result.assignment) == (student, self.folder.name) else None

    def unmarked(
        self, tasks: Iterable[MarkingTask], found: Callable[[JournalEntry], object]
    ) -> Iterator[MarkingTask]:
        """Yield the tasks without a stored result; the results of the others are passed to `found`."""
        for task in tasks:
            entry = self.find(task.student, task.key)
            if entry is None:
                yield task
            else:
                found(entry)

    def discard(self, students: Iterable[str]) -> None:
        """Delete results, so that these submissions are marked again."""
        for student in students:
            self._file(student).unlink(missing_ok=True)

    def save_settings(self, settings: dict[str, Any]) -> None:
        """Store the settings of a run."""
        write_atomically(self.folder / SETTINGS, json.dumps(settings, indent=2) + "\n")

    def pages(self) -> dict[str, str]:
        """The standing that each student's page shows, as a digest."""
        try:
            return dict(json.loads((self.folder / PAGES).read_text()))
        except (OSError, ValueError, TypeError):
            return {}

    def save_pages(self, digests: dict[str, str]) -> None:
        """Store the standings that the pages show."""
        write_atomically(self.folder / PAGES, json.dumps(digests, indent=1) + "\n", 0o600)

    def settings(self) -> dict[str, Any] | None:
        """The settings of the last run, or None if there was none."""
        try:
            return dict(json.loads((self.folder / SETTINGS).read_text()))
        except (OSError, ValueError, TypeError):
            return None

    def _file(self, student: str) -> Path:
        return self.folder / f"{student}.json"


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
