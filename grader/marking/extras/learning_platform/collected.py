"""What was collected from a platform: for each student the number, and the name that feedback must have."""
import json
from collections import defaultdict
from dataclasses import asdict, dataclass
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.extras.learning_platform.platform_users import KnownStudent
from grader.marking.gradebook.book import Book, GradebookStudent
from grader.marking.gradebook.course import Course


@dataclass(frozen=True)
class CollectedUpload:
    """A student's upload. number: the platform's, of this person. attempt: higher for later uploads.

    lasting: whether the number is this person's in every assignment, as in Canvas.
    feedback: where the platform expects the feedback in a ZIP, with `{page}` for the name of the page.
    """

    number: str = ""
    lasting: bool = False
    attempt: int = 0
    feedback: str = ""


def read_collected(course: Course, assignment: str) -> dict[str, CollectedUpload]:
    """The uploads of an assignment by student; {} if none was collected. Raises CourseError."""
    file = _file(course, assignment)
    if not file.exists():
        return {}
    try:
        return {student: CollectedUpload(**each) for student, each in json.loads(file.read_bytes()).items()}
    except (OSError, ValueError, TypeError, AttributeError) as error:
        advice = "delete it, and collect the archive again"
        raise CourseError(f"{file} can't be read ({error}): {advice}") from None


def write_collected(course: Course, assignment: str, uploads: dict[str, CollectedUpload]) -> None:
    """Store the uploads of an assignment. Raises OSError."""
    data = {student: asdict(each) for student, each in sorted(uploads.items())}
    write_atomically(_file(course, assignment), json.dumps(data, indent=1, ensure_ascii=False) + "\n", 0o600)


def known_students(course: Course, assignment: str) -> list[KnownStudent]:
    """Everyone in the gradebook or with a submission, with the platform's numbers."""
    with Book(course) as book:
        about = {each.student: each for each in book.students()}
    numbers: dict[str, set[str]] = defaultdict(set)
    for name in course.assignments():
        for student, each in read_collected(course, name).items():
            if each.lasting or name == assignment:
                numbers[student].add(each.number)
    everyone = sorted({*about, *course.students(assignment), *numbers})
    known = {student: about.get(student) or GradebookStudent(student, "", "", "") for student in everyone}
    return [
        KnownStudent(student, each.first, each.last, each.mail, frozenset(numbers[student]))
        for student, each in known.items()
    ]


def _file(course: Course, assignment: str) -> Path:
    return course.platform_files() / f"{assignment}.json"
