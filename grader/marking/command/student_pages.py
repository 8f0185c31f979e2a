"""Makes the students' pages that are missing or older than the marks."""

import contextlib
from collections.abc import Collection, Mapping

from grader.marking.gradebook.course import Course
from grader.marking.gradebook.feedback import SHARE, is_stale, make_feedback
from grader.marking.gradebook.student_standings import Standing
from grader.marking.journal import Journal
from grader.marking.progress_line import ProgressLine


def update_pages(
    course: Course,
    journal: Journal,
    assignment: str,
    students: Collection[str],
    standings: Mapping[str, Standing],
    jobs: int,
) -> list[str]:
    """Make pages anew, and show the progress if it takes long; return a problem for each page that failed.

    Raises OSError if the disk is full.
    """
    known = journal.pages()
    digests = {name: standings[name].digest if name in standings else "" for name in sorted(students)}
    stale = [
        name
        for name, digest in digests.items()
        if known.get(name, digest) != digest or is_stale(course, assignment, name)
    ]
    failed = _make(course, assignment, stale, jobs) if stale else []
    made = {name: digest for name, digest in digests.items() if name not in failed}
    journal.save_pages(known | made)
    advice = f"`nbgrader generate_feedback {assignment} --force --student"
    return [f"the page of {name} could not be made: {advice} {name}` shows why" for name in failed]


def _make(course: Course, assignment: str, stale: list[str], jobs: int) -> list[str]:
    if len(stale) <= SHARE:
        return make_feedback(course, assignment, stale, jobs)
    with contextlib.closing(ProgressLine(len(stale))) as progress:
        return make_feedback(
            course, assignment, stale, jobs, lambda count: progress.add_line("students' pages", count)
        )
