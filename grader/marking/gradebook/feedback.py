"""Makes the students' pages with nbgrader's `generate_feedback`, for submissions that were marked anew."""
import contextlib
import os
import signal
from collections.abc import Collection, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import repeat
from multiprocessing import get_context
from pathlib import Path

from nbgrader.converters import GenerateFeedback
from nbgrader.converters.base import NbGraderException
from nbgrader.utils import temp_attrs

from grader.marking.gradebook.course import SUBMISSION_SECRET, Course, small_text
from grader.marking.sandbox.linux import die_with_parent

SHARE = 10  # students whose pages take as long as the start of a process
END = b"</html>"


class _Feedback(GenerateFeedback):
    """nbgrader's converter for chosen students; its own takes one or all."""

    def choose(self, folders: Collection[Path]) -> None:
        self.chosen = {str(folder): sorted(map(str, folder.glob("*.ipynb"))) for folder in folders}

    def init_notebooks(self) -> None:
        self.assignments, self.notebooks = self.chosen, []


def make_feedback(course: Course, assignment: str, students: Sequence[str], jobs: int = 1) -> list[str]:
    """Make the pages of these students anew, in up to `jobs` processes; return those that failed."""
    shares = [students[first : first + SHARE] for first in range(0, len(students), SHARE)]
    if jobs == 1 or len(shares) < 2:
        _make(course, assignment, students)
    else:
        workers = ProcessPoolExecutor(min(jobs, len(shares)), get_context("spawn"), initializer=_begin)
        with workers:
            list(workers.map(_make_apart, repeat(course.root), repeat(assignment), shares))
    return [student for student in students if is_stale(course, assignment, student)]


def _make(course: Course, assignment: str, students: Sequence[str]) -> None:
    with temp_attrs(course.directory, assignment_id=assignment):
        converter = _Feedback(coursedir=course.directory, parent=course.app)
        converter.force = True
        converter.choose([course.autograded(student, assignment) for student in students])
        with contextlib.suppress(NbGraderException):  # raised after all pages were tried
            converter.start()


def _begin() -> None:
    """Ignore Ctrl-C in a worker, which ends with the process that started it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    die_with_parent(signal.SIGKILL)


def _make_apart(root: Path, assignment: str, students: Sequence[str]) -> None:
    os.chdir(root)
    _make(Course(root), assignment, students)


def is_stale(course: Course, assignment: str, student: str) -> bool:
    """Whether a page is missing, older than its notebook, truncated, or of another attempt."""
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
