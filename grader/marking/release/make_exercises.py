"""Makes exercises/, the students' version, from solutions/.

    python -m grader.marking.release.make_exercises            make it again
    python -m grader.marking.release.make_exercises --check    compare; exit 1 on a difference
"""
import argparse
import logging
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

from nbgrader.converters import GenerateAssignment
from nbgrader.utils import capture_log

from grader.marking.errors import MarkingError
from grader.marking.gradebook.course import Course
from grader.marking.release.nbgrader_command import assignments, failure
from grader.notebook_format import normalise


def tidy(assignment: str, **_: object) -> None:
    """Bring a released assignment into the course's canonical form of notebooks.

    nbgrader calls this when it has made a release (`GenerateAssignment.post_convert_hook`).
    """
    normalise([Path("exercises", assignment)])


def print_line(line: str) -> None:
    """Print a line without buffering."""
    print(line, flush=True)


def release(course: Path, report: Callable[[str], None] = lambda line: None) -> None:
    """Make course/exercises from course/solutions, and enter the assignments into the gradebook.

    As `nbgrader generate_assignment ASSIGNMENT --force`, for all of them in this process. The contents of
    exercises/ are replaced. report: called with a line at the beginning of each assignment.
    Raises CommandFailed, or CourseError.
    """
    here = Course(course)
    for handler in here.app.log.handlers:
        handler.setLevel(logging.CRITICAL)
    here.app.log.setLevel(logging.ERROR)  # for the message of CommandFailed
    names = assignments(course)
    for number, assignment in enumerate(names, 1):
        report(f"{number} of {len(names)}: exercises/{assignment}")
        here.directory.assignment_id = assignment
        made = capture_log(GenerateAssignment(coursedir=here.directory, parent=here.app, force=True))
        if not made["success"]:
            raise failure(course, f"generate_assignment {assignment} --force", made.get("log", made["error"]))
    for folder in (course / "exercises").glob("*"):
        if folder.name not in assignments(course):
            shutil.rmtree(folder)


def copy_of_course(course: Path, target: Path) -> Path:
    """Copy the sources of a release, solutions/ and nbgrader's configuration; return `target`."""
    left_behind = shutil.ignore_patterns(".ipynb_checkpoints", "__pycache__")
    shutil.copytree(course / "solutions", target / "solutions", ignore=left_behind)
    shutil.copy(course / "nbgrader_config.py", target)
    return target


def differences(course: Path) -> list[str]:
    """Return a sentence for every file of course/exercises that is not what course/solutions gives now.

    Raises as `release`.
    """
    with tempfile.TemporaryDirectory() as folder:
        fresh = copy_of_course(course, Path(folder))
        release(fresh)
        expected, found = _files(fresh / "exercises"), _files(course / "exercises")
    return [
        f"exercises/{name} {_verdict(expected.get(name), found.get(name))}"
        for name in sorted(expected.keys() | found.keys())
        if expected.get(name) != found.get(name)
    ]


def _verdict(expected: bytes | None, found: bytes | None) -> str:
    if found is None:
        return "is missing"
    return "has no source in solutions/" if expected is None else "is not what solutions/ gives now"


def _files(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file() and ".ipynb_checkpoints" not in path.parts)
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def main(arguments: list[str] | None = None) -> int:
    """Run the command line in the course's folder; returns the exit status."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.make_exercises", description="Make exercises/."
    )
    parser.add_argument("--check", action="store_true", help="change nothing; exit 1 on a difference")
    check = parser.parse_args(arguments).check
    try:
        found = differences(Path.cwd()) if check else release(Path.cwd(), print_line)
    except MarkingError as error:
        print(error, file=sys.stderr)
        return 1
    if not found:
        return 0
    print("\n".join([*found, "Run `make exercises` and commit what it changes."]))
    return 1


if __name__ == "__main__":
    sys.exit(main())
