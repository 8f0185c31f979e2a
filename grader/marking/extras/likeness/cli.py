"""`python -m grader likeness ASSIGNMENT`: the command line of comparing the submissions of a class."""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

from grader.marking.errors import CourseError, SandboxFailed, SandboxMissing
from grader.marking.extras.likeness.equal_runs import EqualRuns, equal_runs, run_in_public_worlds
from grader.marking.extras.likeness.likeness_pages import write_pages, write_texts
from grader.marking.extras.likeness.pairs import ClassLikeness, most_alike
from grader.marking.extras.likeness.student_texts import StudentText, read_texts
from grader.marking.gradebook.course import Course
from grader.marking.gradebook.find_submissions import find_submissions
from grader.marking.progress_line import printable
from grader.marking.submission.assignment_release import Release, load_release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask

DESCRIPTION = """Compare the submissions of an assignment in pairs, and show those that are most alike.

Whole notebooks are compared by the structure of what students wrote, without the release's text. Pages with
both texts side by side, and texts.zip for JPlag or Dolos, go to class/likeness/ASSIGNMENT/. With --runs all
submissions are also run in the same worlds: the pages show whose nodes ran equally, to the millisecond, and
how usual that is. A high likeness says that a person should look at both, and nothing else."""
USUAL_PAIRS = 20
SHOWN = 10  # of them, in the terminal
RELEASE = "(the release)"  # as a student who wrote nothing
NOT_STORED = "00"  # in place of the key by which `mark` finds a result again


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader likeness", description=DESCRIPTION, formatter_class=form)
    made.add_argument("assignment", metavar="ASSIGNMENT")
    made.add_argument("--pairs", type=_count, default=USUAL_PAIRS, metavar="N", help="default: 20")
    earlier = "a folder class/submitted of an earlier year, to compare with; may be given again"
    made.add_argument("--earlier", type=Path, action="append", default=[], metavar="FOLDER", help=earlier)
    made.add_argument("--runs", action="store_true", help="also run them, and compare the recordings")
    made.add_argument("--jobs", type=_count, default=2, metavar="N", help="runs at a time; default: 2")
    return made


def main(arguments: list[str] | None = None) -> int:
    """Run the command in the course's folder; returns the exit status."""
    options = parser().parse_args(arguments)
    try:
        course = Course(Path.cwd())
        submissions = find_submissions(course, options.assignment)
        release = load_release(course.release(options.assignment))
        texts, problems = read_texts(submissions, release)
        current = {text.student for text in texts}
        for folder in options.earlier:
            texts += _earlier(folder, release)
        found = most_alike(texts, options.pairs, current)
        given = {RELEASE: course.release(options.assignment)}
        runs = _runs(submissions | given, release, options.jobs) if options.runs else []
        place = course.likeness(options.assignment)
        overview = write_pages(found, runs, options.assignment, place)
        write_texts(texts, release, place / "texts.zip")
    except (CourseError, SandboxMissing, SandboxFailed) as error:
        return _failed(str(error))
    except OSError as error:
        return _failed(f"{error.filename or 'a file'} could not be read or written ({error.strerror})")
    _print(found, overview)
    for student, reason in problems.items():
        print(printable(f"{student} was not compared: {reason}"), file=sys.stderr)
    return 0


def _runs(submissions: Mapping[str, Path], release: Release, jobs: int) -> list[EqualRuns]:
    """Run this year's submissions and the release, and compare them. Raises SandboxMissing, SandboxFailed."""
    tasks = [
        MarkingTask(student, release, read_folder(folder, release), NOT_STORED)
        for student, folder in submissions.items()
    ]
    digests = run_in_public_worlds(tasks, jobs)
    return equal_runs(digests, given=digests.pop(RELEASE))


def _earlier(folder: Path, release: Release) -> list[StudentText]:
    """The texts of an earlier year, under names that say so. Raises CourseError."""
    found = sorted(path for path in folder.glob(f"*/{release.assignment}") if path.is_dir())
    if not found:
        raise CourseError(f"expected submissions in {folder}/STUDENT/{release.assignment}, saw none")
    year = folder.absolute().parent.parent.name
    texts, _ = read_texts({f"{path.parent.name} ({year})": path for path in found}, release)
    return texts


def _print(found: ClassLikeness, overview: Path) -> None:
    for pair in found.pairs[:SHOWN]:
        names = f"{pair.first.student} and {pair.second.student}"
        print(printable(f"{pair.likeness:4.0%}  {names} ({pair.as_like} of {found.total} pairs)"))
    short = f"; {len(found.short)} texts are too short" if found.short else ""
    print(f"{found.total} pairs were compared{short}: {overview}")
    print("Likeness is no proof of anything: look at both texts, and talk with both students.")


def _failed(why: str) -> int:
    print(printable(f"Not compared: {why.rstrip('.')}."), file=sys.stderr)
    return 1


def _count(word: str) -> int:
    if not (word.isdecimal() and 0 < int(word) <= 1000):
        raise argparse.ArgumentTypeError(f"expected a number from 1 to 1000, saw {word!r}")
    return int(word)
