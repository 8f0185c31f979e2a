"""The students' pages, by nbgrader's own `generate_feedback`, for what was marked anew."""
import contextlib
from collections.abc import Collection
from pathlib import Path

from nbgrader.converters import GenerateFeedback
from nbgrader.converters.base import NbGraderException
from nbgrader.utils import temp_attrs

from grader.marking.office.course import Course

END = b"</html>"


class _Feedback(GenerateFeedback):
    """The converter for a choice of students; nbgrader's own takes one or all."""

    def choose(self, folders: Collection[Path]) -> None:
        self.chosen = {str(folder): sorted(map(str, folder.glob("*.ipynb"))) for folder in folders}

    def init_notebooks(self) -> None:
        self.assignments, self.notebooks = self.chosen, []


def make_feedback(course: Course, assignment: str, students: Collection[str]) -> list[str]:
    """Make the pages of these students anew; return those whose page could not be made."""
    with temp_attrs(course.directory, assignment_id=assignment):
        converter = _Feedback(coursedir=course.directory, parent=course.app)
        converter.force = True
        converter.choose([course.autograded(student, assignment) for student in students])
        with contextlib.suppress(NbGraderException):  # it goes on to the end and raises then
            converter.start()
    return [student for student in students if is_stale(course, assignment, student)]


def is_stale(course: Course, assignment: str, student: str) -> bool:
    """Whether a page is missing, older than its notebook, or was cut off while it was written."""
    folder = course.feedback(student, assignment)
    notebooks = course.autograded(student, assignment).glob("*.ipynb")
    return any(not _shows(folder / f"{notebook.stem}.html", notebook) for notebook in notebooks)


def _shows(page: Path, notebook: Path) -> bool:
    try:
        whole = page.read_bytes().rstrip().endswith(END)
        return whole and page.stat().st_mtime_ns >= notebook.stat().st_mtime_ns
    except OSError:
        return False
