"""Shows marking from release to feedback, in a temporary class with three sample students.

    python -m grader.marking.release.demo [assignment]      default: the first one
"""
import argparse
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from nbgrader.api import Gradebook

from grader.marking.errors import CommandFailed
from grader.marking.release.make_exercises import copy_of_course, print_line, release
from grader.marking.release.nbgrader_command import assignments, nbgrader
from grader.marking.release.samples import SHARES, submit_samples
from grader.marking.secret import ACCEPTED


@dataclass(frozen=True)
class SampleMark:
    """A student's marks: points earned and possible per exercise, and the feedback page."""

    student: str
    points: dict[str, tuple[float, float]]
    feedback: Path


def mark_samples(
    course: Path, assignment: str, report: Callable[[str], None] = lambda line: None
) -> list[SampleMark]:
    """Release, submit the samples, mark them and give feedback in `course`. Raises CommandFailed.

    report: called with a line at the beginning of each step.
    """
    release(course, report)
    submit_samples(course, assignment)
    report(f"Running the notebooks of {', '.join(SHARES)} ...")
    nbgrader(course, "autograde", assignment, **{ACCEPTED: "yes"})  # the samples are the course's own
    report("Writing their pages of feedback ...")
    nbgrader(course, "generate_feedback", assignment)
    return [_marks(course, assignment, student) for student in SHARES]


def _marks(course: Path, assignment: str, student: str) -> SampleMark:
    with Gradebook(f"sqlite:///{course}/class/gradebook.db") as gradebook:
        notebooks = gradebook.find_submission(assignment, student).notebooks
        grades = [grade for notebook in notebooks for grade in notebook.grades]
        points = {grade.name: (grade.score, grade.max_score) for grade in grades}
    feedback = course / "class" / "feedback" / student / assignment
    return SampleMark(student, points, next(iter(sorted(feedback.glob("*.html"))), feedback))


def table(marks: list[SampleMark]) -> str:
    """Return the marks as text: an exercise per line, a student per column, then the pages of feedback."""
    worth = {name: possible for name, (_, possible) in marks[0].points.items()}
    rows = {name: [*(marked.points[name][0] for marked in marks), worth[name]] for name in worth}
    rows["total"] = [sum(column) for column in zip(*rows.values(), strict=True)]
    width = max(map(len, rows))
    lines = [" " * width + "".join(f"{title:>12}" for title in [*(marked.student for marked in marks), "of"])]
    lines += [f"{name:{width}}" + "".join(f"{points:12g}" for points in row) for name, row in rows.items()]
    return "\n".join([*lines, "", *(f"feedback for {marked.student}: {marked.feedback}" for marked in marks)])


def main(arguments: list[str] | None = None) -> int:
    """Run the command line in the course's folder; returns the exit status."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.demo", description="Mark sample submissions."
    )
    names = assignments(Path.cwd())
    if not names:
        parser.error(f"expected solutions/*/*.ipynb in {Path.cwd()}, saw none: go to the course's folder")
    parser.add_argument("assignment", nargs="?", choices=names, default=names[0], help="default: the first")
    assignment = parser.parse_args(arguments).assignment
    course = copy_of_course(Path.cwd(), Path(tempfile.mkdtemp(prefix="ros2-course-demo-")))
    print_line(f"Marking three sample submissions of {assignment} in {course} ...")
    try:
        print(table(mark_samples(course, assignment, print_line)))
    except CommandFailed as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
