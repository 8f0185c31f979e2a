"""Judges one submission exactly as `python -m grader mark` does, without a class around it."""
from __future__ import annotations

import shutil
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from grader.marking.errors import CourseError, NotMarked, UnknownTest
from grader.marking.judge.testcells import exercise_names
from grader.marking.mark_evidence import evidence, fingerprint
from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.sandbox import ResourceLimits
from grader.marking.self_check import check_marking
from grader.marking.submission.assignment_release import SUFFIX, Release, load_release
from grader.marking.submission.submitted_files import SubmittedFiles, read_folder, submission_key
from grader.marking.task import MarkingTask, TimeLimits
from grader.marking.version import code_version


@dataclass(frozen=True)
class JudgeSettings:
    """The settings with which a submission is judged.

    secret: private worlds and seeds are derived from it; "" for the public ones. unsafe: without a sandbox.
    self_check: a right answer and a wrong one are judged before.
    """

    secret: str = field(default="", repr=False)
    unsafe: bool = False
    self_check: bool = True
    time_limits: TimeLimits = field(default_factory=TimeLimits)
    limits: ResourceLimits = field(default_factory=ResourceLimits)


@dataclass(frozen=True)
class Judged:
    """A result, with what it was given for; see `mark_evidence`. isolation: that of the student's code."""

    result: Result
    release: Release
    evidence: dict[str, str]
    isolation: str


def read_release(folder: Path) -> Release:
    """The released assignment. Raises CourseError if there is none."""
    release = load_release(folder) if folder.is_dir() else None
    if release is None or not release.notebooks:
        raise CourseError(f"expected an assignment in {folder}, saw no notebook: run `make exercises` first")
    return release


def chosen_cells(release: Release, exercises: Collection[str]) -> frozenset[str]:
    """The test cells of these exercises; of all if there are none. Raises CourseError for an unknown one."""
    found: dict[str, str] = {}
    try:
        for notebook in release.notebooks.values():
            cells = exercise_names(notebook).items()
            found |= {(full.rpartition(".")[2] if full else cell): cell for cell, full in cells}
    except UnknownTest as error:
        raise CourseError(str(error).rstrip(".")) from None
    if unknown := [name for name in exercises if name not in found]:
        raise CourseError(
            f"{release.assignment} has no exercise {unknown[0]!r}: expected one of {', '.join(found)}"
        )
    return frozenset(found[name] for name in exercises)


def read_submission(path: Path, release: Release) -> SubmittedFiles:
    """Read what is handed in: a folder, or a notebook alone. Raises CourseError if there is nothing."""
    if path.is_dir():
        return read_folder(path, release)
    if not (path.is_symlink() or path.is_file()):
        raise CourseError(f"expected a submission, a folder or a notebook, saw no {path}")
    with tempfile.TemporaryDirectory() as place:
        target = Path(place) / path.name
        if path.suffix.lower() != SUFFIX:
            raise CourseError(f"expected a folder or a notebook, saw {path}")
        shutil.copyfile(path, target, follow_symlinks=False)  # a link stays one, which isn't followed
        return read_folder(Path(place), release)


def judge(
    student: str, submitted: SubmittedFiles, release: Release, only: frozenset[str], how: JudgeSettings
) -> Judged:
    """Judge a submission. Raises NotMarked, SandboxMissing and SandboxFailed if no verdict was reached."""
    key = submission_key(submitted, release, fingerprint(how.secret), code_version())
    task = MarkingTask(student, release, submitted, key, only=only)
    with open_pool(how) as pool:
        return judge_in(pool, task, how.secret)


def judge_in(pool: Pool, task: MarkingTask, secret: str) -> Judged:
    """Judge in a pool that has this secret. Raises NotMarked if no verdict was reached."""
    (result,) = pool.mark([task])
    if result.verdict == "broken":
        raise NotMarked(result.reason)
    return Judged(result, task.release, evidence(task, secret), pool.isolation)


@contextmanager
def open_pool(how: JudgeSettings) -> Iterator[Pool]:
    """A pool for one submission. Raises SandboxMissing, SandboxFailed."""
    with Pool(1, how.unsafe, how.secret, how.time_limits, how.limits) as pool:
        if how.self_check:
            check_marking(pool)
        yield pool
