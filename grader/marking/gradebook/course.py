"""A class as nbgrader's configuration describes it: where its folders lie and where its gradebook is."""
import contextlib
import glob
import logging
import os
import re
import stat
from datetime import datetime
from pathlib import Path

from nbgrader.apps import NbGrader
from nbgrader.utils import parse_utc

from grader.marking.errors import CourseError

CONFIGURATION = "nbgrader_config.py"
TIMESTAMP = "timestamp.txt"
LONGEST_TIMESTAMP = 200  # bytes
LONGEST_NAME = 200  # bytes: a file's name may have 255, and students' files have a bit more than their names
SHOWN = 60  # characters of a name that can't be used


class Course:
    """The class in a folder, read from its nbgrader_config.py as nbgrader itself does.

    app: nbgrader's application with that configuration; every converter and plugin of nbgrader takes it.
    Raises CourseError.
    """

    def __init__(self, folder: Path) -> None:
        self.root = folder.absolute()
        if not (self.root / CONFIGURATION).is_file():
            raise CourseError(f"expected {CONFIGURATION} in {self.root}, saw none: go to the course's folder")
        self.app = NbGrader()
        self.app.raise_config_file_errors = True
        self.app.log_level = "CRITICAL"  # it tells of every step; what matters is said by us
        logging.getLogger("tornado.application").disabled = True  # where its gradebook prints tracebacks
        try:
            with contextlib.chdir(self.root):
                self.app.initialize([], root=str(self.root))
        except Exception as error:
            raise CourseError(f"{CONFIGURATION} fails with {type(error).__name__}: {error}") from None
        self.directory = self.app.coursedir

    @property
    def name(self) -> str:
        """The course's id in the gradebook."""
        return self.directory.course_id

    @property
    def database(self) -> str:
        """The gradebook's address, as SQLAlchemy takes it."""
        return self.directory.db_url

    def source(self, assignment: str) -> Path:
        """The assignment with its answers."""
        return self._path(self.directory.source_directory, ".", assignment)

    def release(self, assignment: str) -> Path:
        """The assignment as students got it."""
        return self._path(self.directory.release_directory, ".", assignment)

    def submitted(self, student: str, assignment: str) -> Path:
        """What a student handed in."""
        return self._path(self.directory.submitted_directory, student, assignment)

    def autograded(self, student: str, assignment: str) -> Path:
        """A student's notebooks with the outputs of marking."""
        return self._path(self.directory.autograded_directory, student, assignment)

    def feedback(self, student: str, assignment: str) -> Path:
        """A student's pages."""
        return self._path(self.directory.feedback_directory, student, assignment)

    def journal(self, assignment: str) -> Path:
        """Where marking keeps its results, beside what nbgrader makes of them."""
        return (self.root / self.directory.autograded_directory).parent / "marking" / assignment

    def certificates(self) -> Path:
        """Where certificates and their receipt lie."""
        return (self.root / self.directory.autograded_directory).parent / "certificates"

    def assignments(self) -> list[str]:
        """The names of all assignments that are released."""
        return sorted({notebook.parent.name for notebook in self.release("*").parent.glob("*/*.ipynb")})

    def students(self, assignment: str) -> dict[str, Path]:
        """Every student who handed the assignment in, with the folder. Raises CourseError for odd names."""
        place = self.directory.format_path(
            self.directory.submitted_directory, "(?P<student>.*)", re.escape(assignment), escape=True
        )
        pattern = str(self.submitted("*", glob.escape(assignment)))
        left_out = self.directory.student_id_exclude.split(",")
        matches = {path: re.fullmatch(place, path, re.DOTALL) for path in sorted(glob.glob(pattern))}
        found = {match["student"]: Path(path) for path, match in matches.items() if match}
        for student in found:
            _check_name(student, found[student])
        return {student: folder for student, folder in found.items() if student not in left_out}

    def _path(self, step: str, student: str, assignment: str) -> Path:
        return Path(os.path.normpath(self.directory.format_path(step, student, assignment)))


def _check_name(student: str, folder: Path) -> None:
    """Files are called after students, and the gradebook holds text."""
    length = len(os.fsencode(student))
    plain = student.encode(errors="replace").decode()
    if plain == student and length <= LONGEST_NAME and "\n" not in student:
        return
    saw = f"{length} bytes" if plain == student else "bytes that are no UTF-8"
    saw = "two lines" if "\n" in student else saw
    shown = plain if len(plain) <= SHOWN else f"{plain[:SHOWN]}..."
    expected = f"expected one line of at most {LONGEST_NAME} bytes"
    raise CourseError(
        f"a student's folder has the name {shown!r}, {saw}; {expected}: "
        f"rename it in {str(folder.parent.parent).encode(errors='replace').decode()}"
    )


def timestamp(folder: Path) -> tuple[datetime | None, str]:
    """When a submission was handed in (UTC), from its timestamp.txt, with the file's own text.

    None and "" where there is none, where it is no ordinary file, or where it holds no time.
    """
    try:
        with open(os.open(folder / TIMESTAMP, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
            ordinary = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            text = file.read(LONGEST_TIMESTAMP).decode() if ordinary else ""
        return (parse_utc(text.strip()), text) if text.strip() else (None, "")
    except (OSError, ValueError, OverflowError):
        return None, ""
