"""Makes a student's page of one submission as `mark` does, with a gradebook that exists for that alone."""
import shutil
import tempfile
from pathlib import Path

from nbgrader.api import Gradebook
from nbgrader.preprocessors import SaveCells

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.extras.one_submission.judge_one import Judged
from grader.marking.extras.one_submission.report import LateRule
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import CONFIGURATION, Course
from grader.marking.gradebook.feedback import make_feedback
from grader.marking.gradebook.marked_notebooks import marked_notebooks, write_notebooks
from grader.marking.journal import JournalEntry

PENALTY = "\nc.LateDays.percent_per_day = {}\n"


def write_pages(judged: Judged, late: LateRule | None, configuration: Path, to: Path) -> list[Path]:
    """Write a page for each notebook into the folder `to`. Raises CourseError, OSError.

    configuration: an nbgrader_config.py of the course.
    """
    result, release = judged.result, judged.release
    with tempfile.TemporaryDirectory() as place:
        root = Path(place)
        shutil.copyfile(configuration, root / CONFIGURATION)
        if late:
            with open(root / CONFIGURATION, "a", encoding="utf-8") as file:
                file.write(PENALTY.format(float(late.percent_per_day)))
        course = Course(root)
        _enter_assignment(course, judged, late)
        shown = marked_notebooks(JournalEntry("", result), release)
        with Book(course) as book:
            book.write(result, shown, late.lateness.handed_in if late else None)
        write_notebooks(course, result, shown, "")
        if failed := make_feedback(course, result.assignment, [result.student]):
            raise CourseError(f"the page of {failed[0]} could not be made")
        pages = sorted(course.feedback(result.student, result.assignment).glob("*.html"))
        for page in pages:
            write_atomically(to / page.name, page.read_bytes())
    return [to / page.name for page in pages]


def _enter_assignment(course: Course, judged: Judged, late: LateRule | None) -> None:
    """Enter the release into the gradebook, as nbgrader's `generate_assignment` does."""
    name = judged.result.assignment
    with Gradebook(course.database, course.name) as book:
        book.update_or_create_assignment(name, duedate=late.lateness.due if late else None)
    for notebook, released in judged.release.notebooks.items():
        about = {"assignment": name, "notebook": notebook, "db_url": course.database}
        SaveCells(parent=course.app).preprocess(released, {"nbgrader": about})
