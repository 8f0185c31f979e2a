"""The first step of marking a class: finds each submission's result in the journal, or has a pool make it."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from grader.marking.command.task_reader import TaskReader
from grader.marking.command.unjudged import Unjudged
from grader.marking.journal import Journal, JournalEntry
from grader.marking.mark_evidence import evidence
from grader.marking.progress_line import ProgressLine
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release
from grader.marking.task import MarkingTask, TaskPool


class Marker:
    """Marks submissions; each is read once, when its turn comes.

    enter: called with each result that counts, as soon as it is in the journal. entered: the students whose
    results were. fresh: those of them who were marked now. unjudged: results that were not entered so far.
    """

    def __init__(
        self,
        submissions: Mapping[str, Path],
        journal: Journal,
        release: Release,
        secret: str,
        enter: Callable[[JournalEntry], None],
    ) -> None:
        self._submissions, self._journal, self._release, self._secret = submissions, journal, release, secret
        self._enter = enter
        self._tasks = itertools.starmap(TaskReader(release, secret).read, submissions.items())
        self._waiting: dict[str, tuple[str, dict[str, str]]] = {}  # keys and evidence of what the pool has
        self.entered: set[str] = set()
        self.fresh: list[str] = []
        self.unjudged = Unjudged()

    def mark(self, open_pool: Callable[[], AbstractContextManager[TaskPool]], chosen: Sequence[str]) -> None:
        """Enter each submission's result: the stored one, or that of a pool, which is opened if needed.

        chosen: the students who were named, if any. Raises CourseError if nothing was judged.
        """
        with contextlib.closing(ProgressLine(len(self._submissions))) as progress:
            unmarked = self._unmarked(progress)
            first = next(unmarked, None)
            if first is not None:
                with open_pool() as pool:
                    for result in pool.mark(itertools.chain([first], unmarked)):
                        self._require_requested(result)
                        if result.judged:
                            self._enter_new(result)
                        else:
                            self.unjudged.add(result)
                        progress.add_result(result)
        for result in self.unjudged.release(self.entered, chosen):
            self._enter_new(result)

    def enter_marked(self) -> None:
        """Enter the stored results of the submissions whose turn has not come; the others are left."""
        for _ in self._journal.unmarked(self._tasks, self._enter_stored):
            pass

    def problems(self) -> list[str]:
        """Return a sentence for each student who was not marked."""
        why = self.unjudged.broken
        unmarked = [student for student in self._submissions if student not in self.entered]
        return [f"{student} was not marked: {why.get(student) or 'mark again'}" for student in unmarked]

    def _enter_stored(self, entry: JournalEntry) -> None:
        self.entered.add(entry.result.student)
        self._enter(entry)

    def _enter_new(self, result: Result) -> None:
        self._enter_stored(self._journal.save(result, self._waiting.pop(result.student)[1]))
        self.fresh.append(result.student)

    def _unmarked(self, progress: ProgressLine) -> Iterator[MarkingTask]:
        def found(entry: JournalEntry) -> None:
            self._enter_stored(entry)
            progress.skip()

        for task in self._journal.unmarked(self._tasks, found):
            self._waiting[task.student] = task.key, evidence(task, self._secret)
            yield task

    def _require_requested(self, result: Result) -> None:
        """Raise RuntimeError for a result of another task."""
        key, _ = self._waiting.get(result.student, ("", {}))
        if (result.assignment, result.key) != (self._release.assignment, key):
            raise RuntimeError(f"the pool returned a result for {result.student} that was not requested")
