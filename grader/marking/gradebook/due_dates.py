"""Due dates and extensions: nbgrader has the first, and the second once a student has handed in."""
import json
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError
from grader.marking.gradebook.course import Course

Extensions = dict[str, dict[str, datetime]]  # by assignment and student: until when (UTC)


def read_extensions(course: Course) -> Extensions:
    """All extensions. Raises CourseError."""
    try:
        data = json.loads(_file(course).read_text())
        return {
            name: {student: datetime.fromisoformat(until) for student, until in each.items()}
            for name, each in data.items()
        }
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, TypeError, AttributeError) as error:
        advice = "correct it, or delete it and enter the extensions again"
        raise CourseError(f"{_file(course)} can't be read ({error}): {advice}") from None


def write_extensions(course: Course, extensions: Extensions) -> None:
    """Store all extensions. Raises OSError."""
    data = {
        name: {student: until.isoformat() for student, until in each.items()}
        for name, each in extensions.items()
    }
    write_atomically(_file(course), json.dumps(data, indent=1) + "\n", 0o600)


def write_for_students(course: Course, due: Mapping[str, datetime | None]) -> None:
    """Write the due dates where the start page reads them. Raises OSError."""
    data = {name: when.isoformat() for name, when in due.items() if when}
    write_atomically(course.root / "course" / "due.json", json.dumps(data, indent=1) + "\n")


def _file(course: Course) -> Path:
    return course.platform_files().with_name("extensions.json")
