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

import nbformat
from nbgrader.converters import GenerateAssignment
from nbgrader.utils import capture_log, temp_attrs

from grader.course_files.notebook_format import normalize
from grader.marking.errors import CommandFailed, MarkingError
from grader.marking.gradebook.course import Course
from grader.marking.release.nbgrader_command import assignments, failure
from grader.marking.release.own_choice import FILE, choose, read_choice

ASIDE = ".exercises.part"
REASONS = {  # what nbgrader's log has, and what to do
    "Cannot add or remove cells": (
        "students have submitted it, and solutions/{assignment} has other graded cells than the gradebook. "
        "Undo that change, or give the assignment a new name and hand it out again"
    ),
    "Cannot modify existing assignment": (
        "students have submitted it, and solutions/{assignment} has other notebooks than the gradebook. Undo "
        "that change, or give the assignment a new name and hand it out again"
    ),
    "readonly database": "the gradebook is read-only. Run this as the user who owns it",
    "database is locked": "another program has locked the gradebook. Close it, then run this again",
    "disk is full": "the disk is full. Free some space, then run this again",
}


def tidy(assignment: str, **_: object) -> None:
    """Bring a released assignment into the course's canonical form of notebooks.

    nbgrader calls this when it has made a release (`GenerateAssignment.post_convert_hook`).
    """
    normalize([Path("exercises", assignment)])


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
        _release_one(here, assignment)
    for folder in (course / "exercises").glob("*"):
        if folder.name not in assignments(course):
            shutil.rmtree(folder)


def _release_one(course: Course, assignment: str) -> None:
    """Make one assignment aside, and move it to exercises/ when it is complete."""
    aside, target = course.root / ASIDE / assignment, course.root / "exercises" / assignment
    choice = read_choice(course.root / FILE).get(assignment, {})
    for source in course.source(assignment).glob("*.ipynb") if choice else ():
        choose(nbformat.read(source, 4), choice, assignment)  # for its error, of which nbgrader makes a log
    try:
        with temp_attrs(course.directory, assignment_id=assignment, release_directory=ASIDE):
            converter = GenerateAssignment(coursedir=course.directory, parent=course.app, force=True)
            converter.post_convert_hook = _no_hook  # it is for a release that is made in place
            made = capture_log(converter)
        if not made["success"]:
            log = made.get("log") or made["error"]
            reason = next((text for sign, text in REASONS.items() if sign in log), "")
            if reason:
                why = reason.format(assignment=assignment)
                raise CommandFailed(f"exercises/{assignment} is as it was: {why}")
            raise failure(course.root, f"generate_assignment {assignment} --force", log)
        normalize([aside])
        shutil.rmtree(target, ignore_errors=True)
        target.parent.mkdir(exist_ok=True)
        aside.rename(target)
    finally:
        shutil.rmtree(course.root / ASIDE, ignore_errors=True)


def _no_hook(**_: object) -> None:
    """Does nothing."""


def copy_of_course(course: Path, target: Path) -> Path:
    """Copy the sources of a release, solutions/ and nbgrader's configuration; return `target`."""
    left_behind = shutil.ignore_patterns(".ipynb_checkpoints", "__pycache__")
    shutil.copytree(course / "solutions", target / "solutions", ignore=left_behind)
    shutil.copy(course / "nbgrader_config.py", target)
    if (course / FILE).exists():
        (target / FILE).parent.mkdir()
        shutil.copy(course / FILE, target / FILE)
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
    return "has no source in solutions/" if expected is None else "is not what solutions/ produces now"


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
        found = differences(Path.cwd()) if check else []
        if not check:
            release(Path.cwd(), print_line)
    except MarkingError as error:
        print(error, file=sys.stderr)
        return 1
    if not found:
        return 0
    print("\n".join([*found, "Run `make exercises` and commit what it changes."]))
    return 1


if __name__ == "__main__":
    sys.exit(main())
