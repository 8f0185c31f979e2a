"""Which students' nodes ran equally, to the millisecond, and how usual that is in an exercise."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import comb

from grader.marking.judge.personal_release import common_release
from grader.marking.pool import Pool
from grader.marking.progress_line import ProgressLine
from grader.marking.result import Result
from grader.marking.task import MarkingTask

RARE = 0.02  # of all pairs: equal runs that more pairs have come from the task
Digests = tuple[str, ...]  # of an exercise's recordings


@dataclass(frozen=True)
class EqualRuns:
    """The equal runs of one exercise. groups: students whose recordings are equal, the largest group first.

    pairs, total: how many pairs of students ran equally, and how many ran at all.
    """

    exercise: str
    groups: tuple[tuple[str, ...], ...]
    pairs: int
    total: int

    @property
    def share(self) -> float:
        """The share of all pairs that ran equally: how often it is expected of two students by chance."""
        return self.pairs / self.total if self.total else 0.0

    @property
    def rare(self) -> bool:
        """Return whether so few pairs ran equally that it doesn't come from the task alone."""
        return 0 < self.share <= RARE

    def has(self, first: str, second: str) -> bool:
        """Return whether these two ran equally."""
        return any(first in group and second in group for group in self.groups)


def run_in_public_worlds(tasks: Iterable[MarkingTask], jobs: int) -> dict[str, dict[str, Digests]]:
    """Run all submissions in the same worlds; return each exercise's digests by student.

    Private worlds differ for each student, so there no two students' runs are equal. Variants aren't drawn:
    only the runs count, not their points. Raises SandboxMissing, SandboxFailed.
    """
    all_tasks = [replace(task, release=common_release(task.release)) for task in tasks]
    progress = ProgressLine(len(all_tasks))
    found = {}
    with Pool(jobs) as pool:
        for result in pool.mark(all_tasks):
            progress.add_result(result)
            found[result.student] = _digests(result)
    progress.close()
    return found


def _digests(result: Result) -> dict[str, Digests]:
    cells = [cell for note in result.notebooks for cell in note.cells]
    return {cell.exercise: tuple(cell.digests) for cell in cells if cell.digests}


def equal_runs(digests: Mapping[str, Mapping[str, Digests]], given: Mapping[str, Digests]) -> list[EqualRuns]:
    """Compare the runs of each exercise.

    digests: those of `run_in_public_worlds`. given: the release's own; who has these wrote nothing.
    """
    by_exercise: defaultdict[str, dict[str, Digests]] = defaultdict(dict)
    for student, exercises in sorted(digests.items()):
        for exercise, recorded in exercises.items():
            if recorded != given.get(exercise):
                by_exercise[exercise][student] = recorded
    return [_of_exercise(name, recorded) for name, recorded in by_exercise.items()]


def _of_exercise(name: str, recorded: Mapping[str, Digests]) -> EqualRuns:
    counts = Counter(recorded.values())
    groups = [
        tuple(student for student, digest in recorded.items() if digest == each)
        for each, count in counts.most_common()
        if count > 1
    ]
    pairs = sum(comb(len(group), 2) for group in groups)
    return EqualRuns(name, tuple(groups), pairs, comb(len(recorded), 2))
