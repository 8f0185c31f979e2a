"""What was collected from a platform: of each student the number, the lateness, and the name for feedback."""
import json
from dataclasses import asdict, dataclass

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.gradebook.course import Course


@dataclass(frozen=True)
class CollectedUpload:
    """A student's upload. number: the platform's, of this person. attempt: higher for later uploads.

    lasting: whether the number is this person's in every assignment, as in Canvas.
    feedback: where the platform expects the feedback in a ZIP, with `{page}` for the name of the page.
    late: whether the platform marks it as late; None if it marks nothing. time: when it was handed in, in
    ISO format and UTC, or "" if the platform doesn't report it.
    """

    number: str = ""
    lasting: bool = False
    attempt: int = 0
    feedback: str = ""
    late: bool | None = None
    time: str = ""

    def is_older(self, other: "CollectedUpload") -> bool:
        """Return whether it was uploaded before another one, as far as that is known."""
        return self.attempt < other.attempt or "" < self.time < other.time


def read_collected(course: Course, assignment: str) -> dict[str, CollectedUpload]:
    """The uploads of an assignment by student; {} if none was collected. Raises CourseError."""
    file = course.platform_files() / f"{assignment}.json"
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
    file = course.platform_files() / f"{assignment}.json"
    write_atomically(file, json.dumps(data, indent=1, ensure_ascii=False) + "\n", 0o600)
