"""Lists the submissions whose time isn't known, so that no one counts as punctual without a reason."""
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from grader.marking.errors import CourseError
from grader.marking.gradebook.collected_uploads import read_collected
from grader.marking.gradebook.course import TIMESTAMP, Course, time_problem, timestamp

WRITE = "write the time, such as 2026-03-01 18:00:00 +0100, into"
SHOWN = 20  # names


def time_notes(
    course: Course, assignment: str, submissions: Mapping[str, Path], due: bool
) -> Iterator[tuple[str, str]]:
    """Yield of whom, and what the instructor should know. due: whether the assignment has a due date."""
    try:
        uploads = read_collected(course, assignment)
    except CourseError as error:
        uploads = {}
        yield assignment, str(error)
    unknown = []
    for student, folder in submissions.items():
        late = uploads[student].late if student in uploads else None
        if problem := time_problem(folder):
            yield student, problem
        elif not due or late is False or timestamp(folder)[0]:
            continue
        elif late:
            shown = folder.relative_to(course.root) / TIMESTAMP
            yield student, (
                "late, as the platform says, but it doesn't say by how much, so no points are deducted here: "
                f"{WRITE} {shown}, or let the platform deduct points"
            )
        else:
            unknown.append(student)
    if unknown:
        file = course.submitted("STUDENT", assignment).relative_to(course.root) / TIMESTAMP
        yield _names(unknown), (
            "the time of submission isn't known, so it doesn't count as late: collect Moodle's archive again "
            f"with its worksheet, `--moodle FILE`, or {WRITE} {file}"
        )


def _names(students: Sequence[str]) -> str:
    more = len(students) - SHOWN
    return ", ".join(students[:SHOWN]) + (f" and {more} others" if more > 0 else "")
