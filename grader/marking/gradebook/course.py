"""A class as nbgrader's configuration describes it: the paths of its folders and gradebook."""
import contextlib
import glob
import logging
import os
import re
import stat
from datetime import UTC, datetime, timedelta
from pathlib import Path

import dateutil.parser
import dateutil.tz
from nbgrader.apps import NbGrader
from nbgrader.utils import parse_utc

from grader.marking.errors import CourseError

CONFIGURATION = "nbgrader_config.py"
TIMESTAMP = "timestamp.txt"
SUBMISSION_SECRET = "submission_secret.txt"  # of nbgrader's exchange: names the feedback of an attempt
MAX_SMALL_BYTES = 200
OFFSET = re.compile(r"[+-]\d\d:?\d\d")
A_YEAR = timedelta(days=366)
FORBIDDEN = set('<>"&')  # in a student's id, which nbgrader writes into its pages as it is
MAX_NAME_BYTES = 200  # a file's name may have 255, and students' files have longer names than the students
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
        self.app.log_level = "CRITICAL"  # it logs every step; what matters is printed by the commands
        logging.getLogger("tornado.application").disabled = True  # to which its gradebook logs tracebacks
        try:
            with contextlib.chdir(self.root):
                self.app.initialize([], root=str(self.root))
        except Exception as error:
            raise CourseError(f"{CONFIGURATION} fails with {type(error).__name__}: {error}") from None
        self.directory = self.app.coursedir

    @property
    def name(self) -> str:
        """The course's id in the gradebook."""
        return str(self.directory.course_id)

    @property
    def database(self) -> str:
        """The gradebook's address, as SQLAlchemy takes it."""
        return str(self.directory.db_url)

    def source(self, assignment: str) -> Path:
        """The assignment with its answers."""
        return self._path(self.directory.source_directory, ".", assignment)

    def release(self, assignment: str) -> Path:
        """The assignment as it is handed out."""
        return self._path(self.directory.release_directory, ".", assignment)

    def submitted(self, student: str, assignment: str) -> Path:
        """A student's submission."""
        return self._path(self.directory.submitted_directory, student, assignment)

    def autograded(self, student: str, assignment: str) -> Path:
        """A student's notebooks with the outputs of marking."""
        return self._path(self.directory.autograded_directory, student, assignment)

    def feedback(self, student: str, assignment: str) -> Path:
        """A student's pages."""
        return self._path(self.directory.feedback_directory, student, assignment)

    def journal(self, assignment: str) -> Path:
        """The folder in which marking stores its results, beside nbgrader's."""
        return self._beside_marked("marking", assignment)

    def table(self, assignment: str) -> Path:
        """The file with the points of a large class."""
        return self.journal(assignment).with_name(f"{assignment}.csv")

    def receipts(self) -> Path:
        """The folder of receipts and certificates."""
        return self._beside_marked("receipts")

    def likeness(self, assignment: str) -> Path:
        """The folder with the pages that compare the submissions."""
        return self._beside_marked("likeness", assignment)

    def variants(self, student: str, assignment: str) -> Path:
        """The folder with a student's own release of an assignment with variants."""
        return self._beside_marked("variants", student, assignment)

    def platform_files(self) -> Path:
        """The folder with what is known of a learning platform's uploads."""
        return self._beside_marked("platform")

    def _beside_marked(self, *names: str) -> Path:
        return (self.root / str(self.directory.autograded_directory)).parent.joinpath(*names)

    def assignments(self) -> list[str]:
        """The names of all assignments that are released."""
        return sorted({notebook.parent.name for notebook in self.release("*").parent.glob("*/*.ipynb")})

    def students(self, assignment: str) -> dict[str, Path]:
        """The students who handed the assignment in, with folders; without those of `odd_folders`."""
        found = self._folders(assignment)
        return {student: folder for student, folder in found.items() if not _name_problem(student)}

    def odd_folders(self, assignment: str) -> dict[str, str]:
        """Return why folders with the assignment are left out, by their printable names."""
        problems = {_shown(student): _name_problem(student) for student in self._folders(assignment)}
        return {name: problem for name, problem in problems.items() if problem}

    def _folders(self, assignment: str) -> dict[str, Path]:
        place = self.directory.format_path(
            self.directory.submitted_directory, "(?P<student>.*)", re.escape(assignment), escape=True
        )
        pattern = str(self.submitted("*", glob.escape(assignment)))
        left_out = self.directory.student_id_exclude.split(",")
        matches = {path: re.fullmatch(place, path, re.DOTALL) for path in sorted(glob.glob(pattern))}
        found = {match["student"]: Path(path) for path, match in matches.items() if match}
        return {student: folder for student, folder in found.items() if student not in left_out}

    def hidden_students(self, assignment: str) -> list[str]:
        """The names of folders with the assignment that begin with a dot, which nbgrader leaves out."""
        pattern = str(self.submitted(".*", glob.escape(assignment)))
        top = self.submitted("STUDENT", assignment).parents[1]
        return sorted(Path(path).relative_to(top).parts[0] for path in glob.glob(pattern))

    def _path(self, step: str, student: str, assignment: str) -> Path:
        return Path(os.path.normpath(self.directory.format_path(step, student, assignment)))


def _name_problem(student: str) -> str:
    """Return why a name can't be the name of a file or a text in the gradebook; "" if it can."""
    length, odd = len(os.fsencode(student)), sorted(FORBIDDEN & set(student))
    saw = "more than one line" if len(student.splitlines()) > 1 or "\n" in student else ""
    saw = saw or (f"{' and '.join(odd)}" if odd else "")
    saw = saw or ("bytes that aren't UTF-8" if student != student.encode(errors="replace").decode() else "")
    saw = saw or (f"{length} bytes, of at most {MAX_NAME_BYTES}" if length > MAX_NAME_BYTES else "")
    return f"the folder's name has {saw}, so it is left out: rename it" if saw else ""


def _shown(student: str) -> str:
    """The name in quotes, shortened, with escapes for what can't be printed."""
    plain = student.encode(errors="replace").decode()
    return repr(plain if len(plain) <= SHOWN else f"{plain[:SHOWN]}...")


def timestamp(folder: Path) -> tuple[datetime | None, str]:
    """Return when a submission was handed in (UTC), from its timestamp.txt, with the text of this file.

    None and "" if there is none, if it is not a regular file, or if it has no time.
    """
    text = small_text(folder, TIMESTAMP)
    return (None, "") if not text.strip() or time_problem(folder) else (_parse_time(text), text)


def write_timestamp(folder: Path, when: datetime) -> None:
    """Write when a submission was handed in (UTC), as nbgrader's exchange does. Raises OSError."""
    (folder / TIMESTAMP).write_text(f"{when:%Y-%m-%d %H:%M:%S} UTC\n")


def time_problem(folder: Path) -> str:
    """Return why the time in a submission's timestamp.txt can't be used, without a full stop; or ""."""
    text = small_text(folder, TIMESTAMP).strip()
    if not text:
        return ""
    saw = f"{TIMESTAMP} has {text[:SHOWN]!r}"
    try:
        when = _parse_time(text)
    except (ValueError, OverflowError):
        return (
            f"{saw}, which is not a time, so nothing counts as late: write one such as 2026-03-01 18:00:00 "
            "+0100"
        )
    if when > datetime.now(UTC).replace(tzinfo=None) + A_YEAR:
        return f"{saw}, which is far in the future, so nothing counts as late: correct it"
    return ""


def small_text(folder: Path, name: str) -> str:
    """The text of a small file that came with a submission; "" if it is missing or no regular file."""
    try:
        with open(os.open(folder / name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb") as file:
            regular = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            return file.read(MAX_SMALL_BYTES).decode(errors="replace") if regular else ""
    except OSError:
        return ""


def _parse_time(text: str) -> datetime:
    """UTC. nbgrader takes an offset such as +0200 for 200 s, and an unknown zone for UTC."""
    *_, zone = text.split()
    has_offset = OFFSET.fullmatch(zone) is not None
    if not has_offset and len(text.split()) == 3 and dateutil.tz.gettz(zone) is None:
        raise ValueError(f"unknown zone {zone}")
    time: datetime = parse_utc(dateutil.parser.parse(text) if has_offset else text.strip())
    return time
