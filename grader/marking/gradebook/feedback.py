"""Makes the students' pages with nbgrader's `generate_feedback`, for submissions that were marked anew."""
import contextlib
import errno
import os
import signal
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import repeat
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from nbgrader.converters import GenerateFeedback
from nbgrader.converters.base import NbGraderException
from nbgrader.utils import temp_attrs

from grader.marking.gradebook.course import SUBMISSION_SECRET, Course, small_text
from grader.marking.sandbox.linux import die_with_parent

SHARE = 10  # students whose pages take as long as the start of a process
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)  # what a page that can't be stored fails with
END = b"</html>"


class _Feedback(GenerateFeedback):  # type: ignore[misc]
    """nbgrader's converter for chosen students; its own takes one or all."""

    def choose(self, folders: Collection[Path]) -> None:
        self.chosen = {str(folder): sorted(map(str, folder.glob("*.ipynb"))) for folder in folders}

    def init_notebooks(self) -> None:
        self.assignments = self.chosen
        self.notebooks: list[str] = []

    def init_assignment(self, assignment_id: str, student_id: str) -> None:
        with _stopping_if_full(self._format_dest(assignment_id, student_id)):
            super().init_assignment(assignment_id, student_id)

    def write_single_notebook(self, output: str, resources: dict[str, Any]) -> None:
        about = resources["nbgrader"]
        with _stopping_if_full(self._format_dest(about["assignment"], about["student"])):
            super().write_single_notebook(output, resources)


class _DiskFull(BaseException):
    """No further page can be stored; nbgrader would catch an Exception, and go on."""


@contextlib.contextmanager
def _stopping_if_full(place: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        if error.errno not in FULL:
            raise
        raise _DiskFull(error.errno, error.strerror, error.filename or place) from None


def make_feedback(
    course: Course, assignment: str, students: Sequence[str], jobs: int = 1,
    report: Callable[[int], None] = lambda count: None,
) -> list[str]:
    """Make the pages of these students anew, in up to `jobs` processes; return those that failed.

    report: called with the number of students that are done since the last call. Raises OSError if the disk
    is full.
    """
    shares = [students[first : first + SHARE] for first in range(0, len(students), SHARE)]
    with contextlib.ExitStack() as stack:
        if jobs == 1 or len(shares) < 2:
            done: Iterator[int] = (_make(course, assignment, share) for share in shares)
        else:
            count = min(jobs, len(shares))
            workers = ProcessPoolExecutor(count, get_context("spawn"), initializer=_begin)
            stack.callback(workers.shutdown, cancel_futures=True)
            done = workers.map(_make_apart, repeat(course.root), repeat(assignment), shares)
        for count in done:
            report(count)
    return [student for student in students if is_stale(course, assignment, student)]


def _make(course: Course, assignment: str, students: Sequence[str]) -> int:
    """Make the pages of a share, and return how many students it has. Raises OSError if the disk is full."""
    with temp_attrs(course.directory, assignment_id=assignment):
        converter = _Feedback(coursedir=course.directory, parent=course.app)
        converter.force = True
        converter.choose([course.autograded(student, assignment) for student in students])
        try:
            converter.start()
        except NbGraderException:  # raised after all pages were tried
            pass
        except _DiskFull as full:
            raise OSError(*full.args) from None
    return len(students)


def _begin() -> None:
    """Ignore Ctrl-C in a worker, which ends with the process that started it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    die_with_parent(signal.SIGKILL)


def _make_apart(root: Path, assignment: str, students: Sequence[str]) -> int:
    os.chdir(root)
    return _make(Course(root), assignment, students)


def is_stale(course: Course, assignment: str, student: str) -> bool:
    """Return whether a page is missing, older than its notebook, truncated, or of another attempt."""
    folder, marked = course.feedback(student, assignment), course.autograded(student, assignment)
    notebooks = marked.glob("*.ipynb")
    if small_text(folder, SUBMISSION_SECRET) != small_text(marked, SUBMISSION_SECRET):
        return True
    return any(not _shows(folder / f"{notebook.stem}.html", notebook) for notebook in notebooks)


def _shows(page: Path, notebook: Path) -> bool:
    try:
        whole = page.read_bytes().rstrip().endswith(END)
        return whole and page.stat().st_mtime_ns >= notebook.stat().st_mtime_ns
    except OSError:
        return False
