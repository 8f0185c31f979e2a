"""Packs the students' pages into the ZIP that Moodle and Canvas take back as feedback."""
import io
import zipfile
from collections.abc import Mapping
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.extras.learning_platform.platform_users import PlatformUser
from grader.marking.extras.learning_platform.upload_names import moodle_folder
from grader.marking.gradebook.collected_uploads import read_collected
from grader.marking.gradebook.course import Course

PAGE = "feedback.html"


def write_feedback_zip(
    course: Course, assignment: str, path: Path, people: Mapping[str, PlatformUser]
) -> tuple[int, list[str]]:
    """Write the ZIP; return how many students are in it, and a sentence for each who is not.

    people: those of a Moodle worksheet by student, for students without a collected upload. Raises
    CourseError, OSError.
    """
    places = {student: each.feedback for student, each in read_collected(course, assignment).items()}
    folders = {who: f"{moodle_folder(each.name, each.number)}/{{page}}" for who, each in people.items()}
    places = folders | {student: place for student, place in places.items() if place}
    students = sorted(course.students(assignment))
    if not places:
        raise CourseError(
            f"it isn't known what the platform calls the students of {assignment}: "
            "collect its archive, or give its worksheet with --moodle"
        )
    packed, problems, file = 0, [], io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for student in students:
            pages = sorted(course.feedback(student, assignment).glob("*.html"))
            if student not in places:
                problems.append(f"{student}: was not collected from the platform, and is not in {path}")
            elif not pages:
                problems.append(f"{student}: has no page, and is not in {path}: mark {assignment} first")
            else:
                packed += 1
                for page in pages:
                    name = PAGE if len(pages) == 1 else page.name
                    archive.writestr(places[student].format(page=name), page.read_bytes())
    write_atomically(path, file.getvalue(), 0o600)
    return packed, problems
