"""Reads submissions into the tasks of marking them."""
from pathlib import Path

from grader.marking.mark_evidence import fingerprint
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder, submission_key
from grader.marking.task import MarkingTask
from grader.marking.version import code_version


class TaskReader:
    """Reads submissions for `release`, each into a task: its key is that of the bytes that will be marked."""

    def __init__(self, release: Release, secret: str = "") -> None:
        self.release = release
        self._fingerprint, self._version = fingerprint(secret), code_version()

    def read(self, student: str, folder: Path) -> MarkingTask:
        """The task of marking what is in a student's folder now. Raises nothing, whatever that is."""
        submitted = read_folder(folder, self.release)
        key = submission_key(submitted, self.release, self._fingerprint, self._version)
        return MarkingTask(student, self.release, submitted, key)
