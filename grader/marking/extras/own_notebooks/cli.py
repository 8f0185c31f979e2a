"""`python -m grader variants ASSIGNMENT`: writes each student's own notebooks."""
import argparse
import sys
import zipfile
from collections.abc import Mapping
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from grader.course_files.notebook_format import normalized
from grader.marking import secret
from grader.marking.atomic_file import write_atomically
from grader.marking.errors import CourseError, NoVariants
from grader.marking.gradebook.book import Book
from grader.marking.gradebook.course import Course
from grader.marking.judge.personal_release import (
    NO_SECRET,
    drawn_numbers,
    has_variants,
    personal_notebook,
    personal_release,
)
from grader.marking.progress_line import printable
from grader.marking.submission.assignment_release import SUFFIX, Release, load_release
from grader.seeds import secret_of_student

DESCRIPTION = """Write each student's own notebooks of an assignment with variants.

They go to class/variants/STUDENT/ASSIGNMENT/.
An assignment has variants if class/course.toml says `variants = true` for it, and `make exercises` has made
it since. The variant of a student follows from .secret and the student's name, so names have to be those by
which submissions are marked, and the command can be repeated."""
UNTAGGED = (
    "expected `variants = true` below [{0!r}] in class/course.toml and then `make exercises`, "
    "saw no variants in {1}"
)
ANSWERS = "-answers"
ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a ZIP can hold


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader variants", description=DESCRIPTION, formatter_class=form)
    add = made.add_argument
    add("assignment", metavar="ASSIGNMENT", help="such as 02_topics")
    add("--student", action="append", default=[], metavar="NAME", help="only this one; may be given again")
    add("--students", type=Path, metavar="FILE", help="a name per line; default: everyone in the gradebook")
    add("--zip", action="store_true", help="write ZIPs that students unpack in the course's folder")
    answers = f"write the notebooks with answers, for you alone, to class/variants{ANSWERS}"
    add("--answers", action="store_true", help=answers)
    return made


def main(arguments: list[str] | None = None) -> int:
    """Run the command in the course's folder; returns the exit status."""
    options = parser().parse_args(arguments)
    try:
        course = Course(Path.cwd())
        release, key = _release(course, options.assignment), secret.read(course.root)
        if not key:
            raise NoVariants(NO_SECRET.format(options.assignment))
        students = _students(course, options.student, options.students)
        for student in students:
            own = secret_of_student(key, student)
            folder = course.variants(student, options.assignment)
            if options.answers:
                folder = _answers_folder(folder)
                files = _with_answers(course, release, own)
            else:
                files = _files(personal_release(release, own))
            _write(files, folder, options.assignment, options.zip)
    except CourseError as error:
        print(printable(f"No variants: {error}."), file=sys.stderr)
        return 1
    except OSError as error:
        why = f"{error.filename or 'a file'} could not be read or written ({error.strerror})"
        print(printable(f"No variants: {why}."), file=sys.stderr)
        return 1
    where = course.variants("STUDENT", options.assignment).relative_to(course.root)
    shown = _answers_folder(where) if options.answers else where
    whose = "1 student" if len(students) == 1 else f"{len(students)} students"
    print(f"{shown}{'.zip' if options.zip else '/'}: {whose}")
    return 0


def _release(course: Course, assignment: str) -> Release:
    """The release with variants. Raises CourseError if there is none."""
    folder = course.release(assignment)
    release = load_release(folder) if folder.is_dir() else None
    where = folder.relative_to(course.root)
    if release is None or not release.notebooks:
        raise CourseError(f"expected an assignment in {where}, saw no notebook: run `make exercises` first")
    if not has_variants(release.notebooks.values()):
        raise NoVariants(UNTAGGED.format(assignment, where))
    return release


def _students(course: Course, names: list[str], file: Path | None) -> list[str]:
    """The students to write for. Raises CourseError, OSError."""
    found = list(names)
    if file:
        found += filter(None, map(str.strip, file.read_text(encoding="utf-8").splitlines()))
    if not found:
        with Book(course) as book:
            found = [each.student for each in book.students()]
    if not found:
        raise CourseError("expected --student NAME or --students FILE, because the gradebook has no students")
    for name in found:
        if name.startswith(".") or set(name) & set("/\0"):
            raise CourseError(f"expected the name of a student, without `/` and no dot first, saw {name!r}")
    return sorted(set(found))


def _files(release: Release) -> dict[str, bytes]:
    """The files of a release by path."""
    return {**release.files, **_notebooks(release.notebooks)}


def _with_answers(course: Course, release: Release, own: str) -> dict[str, bytes]:
    """The notebooks with answers of a student. own: the student's secret."""
    numbers = drawn_numbers(release.notebooks.values(), own)
    paths = {name: course.source(release.assignment) / f"{name}{SUFFIX}" for name in release.notebooks}
    read = {name: nbformat.read(path, 4) for name, path in paths.items()}
    return _notebooks({name: personal_notebook(notebook, numbers) for name, notebook in read.items()})


def _notebooks(notebooks: Mapping[str, NotebookNode]) -> dict[str, bytes]:
    texts = {f"{name}{SUFFIX}": nbformat.writes(notebook) for name, notebook in notebooks.items()}
    return {name: normalized(text, name).encode() for name, text in texts.items()}


def _answers_folder(folder: Path) -> Path:
    """The folder with answers beside one that students get."""
    top = folder.parents[1]
    return top.with_name(top.name + ANSWERS) / folder.relative_to(top)


def _write(files: Mapping[str, bytes], folder: Path, assignment: str, as_zip: bool) -> None:
    if not as_zip:
        for name, content in files.items():
            write_atomically(folder / name, content)
        return
    folder.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(folder.with_name(f"{assignment}.zip"), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(f"exercises/{assignment}/{name}", ZIP_EPOCH)
            entry.create_system, entry.external_attr = 3, 0o100644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
