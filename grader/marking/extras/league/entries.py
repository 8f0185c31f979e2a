"""The entries of a league: a class's capstones and the reference, or given notebooks."""

from __future__ import annotations

import functools
import importlib.util
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from grader.marking.errors import CourseError, Unusable
from grader.marking.extras.league.contest import Contest
from grader.marking.extras.league.contest_procedure import ContestProcedure
from grader.marking.extras.league.standings import REFERENCE
from grader.marking.submission.assignment_release import SUFFIX, Release, load_release
from grader.marking.submission.submitted_files import (
    MAX_NOTEBOOK_BYTES,
    SubmittedFiles,
    read_folder,
    submission_key,
)
from grader.marking.submission.untrusted_folder import FILE, FolderEntry, read_file
from grader.marking.task import MarkingTask
from grader.marking.version import code_version

LEAGUE = "grader/marking/extras/league"  # its code decides the results, too


@dataclass(frozen=True)
class Entries:
    """The entries for a release. read: reads the files of each entry; it raises nothing."""

    release: Release
    read: Mapping[str, Callable[[], SubmittedFiles]]

    def tasks(self, contest: Contest) -> Iterator[MarkingTask]:
        """The task of each entry, read when it is requested."""
        return map(functools.partial(self._task, contest), self.read)

    def _task(self, contest: Contest, student: str) -> MarkingTask:
        submitted = self.read[student]()
        key = submission_key(submitted, self.release, repr(contest), code_version(LEAGUE))
        return MarkingTask(student, self.release, submitted, key, ContestProcedure(contest))


def of_class(folder: Path, assignment: str) -> Entries:
    """All submissions of the course in this folder, and the reference. Raises CourseError."""
    if importlib.util.find_spec("grader.marking.gradebook") is None:  # this is the handout
        raise CourseError("only instructors have a class's submissions: name your notebooks")
    from grader.marking.gradebook.course import Course
    from grader.marking.gradebook.find_submissions import find_submissions

    course = Course(folder)
    found = find_submissions(course, assignment)
    if course.source(assignment).is_dir():
        found[REFERENCE] = course.source(assignment)
    release = load_release(course.release(assignment))
    return Entries(release, {name: functools.partial(read_folder, at, release) for name, at in found.items()})


def of_notebooks(folder: Path, assignment: str, notebooks: Iterable[str]) -> Entries:
    """These versions of the capstone, for the course in this folder. Raises CourseError."""
    place = folder / "exercises" / assignment
    if not any(place.glob(f"*{SUFFIX}")):
        raise CourseError(f"expected the assignment {assignment} in {place.parent}, saw none")
    release = load_release(place)
    found: dict[str, Callable[[], SubmittedFiles]] = {}
    for path in map(Path, notebooks):
        if path.stem in found:
            raise CourseError(f"two notebooks are called {path.stem}: give each version a name of its own")
        if path.suffix != SUFFIX or path.stem.startswith("."):
            raise CourseError(f"expected a notebook such as my_robot{SUFFIX}, saw {path}")
        if not path.exists():
            raise CourseError(f"there is no notebook {path}")
        found[path.stem] = functools.partial(_submitted, _content(path), list(release.notebooks)[-1])
    return Entries(release, found)


def _content(path: Path) -> bytes:
    try:
        return read_file(path.absolute().parent, path.name, MAX_NOTEBOOK_BYTES)
    except Unusable as reason:
        raise CourseError(str(reason)) from None


def _submitted(content: bytes, name: str) -> SubmittedFiles:
    """The files of a submission of this notebook alone, under the assignment's name for it."""
    file = name + SUFFIX
    return SubmittedFiles((FolderEntry(file, FILE, len(content)),), {file: content})
