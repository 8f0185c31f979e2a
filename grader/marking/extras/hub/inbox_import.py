"""Takes submissions out of the students' inboxes into a folder that students can't change.

An inbox is written by its student: what is in it may be anything, and may change at any time.
"""
import os
import pwd
import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path

from nbgrader.utils import parse_utc

from grader.marking.errors import Unusable
from grader.marking.submission.quoting import quote
from grader.marking.submission.untrusted_folder import FILE, FOLDER, list_entries, read_file

TIMESTAMP = "timestamp.txt"
SECRET = "submission_secret.txt"
FORM = "%Y-%m-%d %H:%M:%S.%f %Z"  # nbgrader's own
# nbgrader names a submission STUDENT+ASSIGNMENT+TIME+RANDOM.
NAME = re.compile(r"(?P<student>[^+/]+)\+(?P<assignment>[\w.-]+)\+(?P<time>[^+/]+)\+(?P<key>[\w=-]{8,40})")
TOLERANCE = timedelta(minutes=2)  # nbgrader takes the time first and copies the files then
MAX_FILES, MAX_BYTES = 1000, 128 * 10**6
MAX_WAITING = 100  # submissions in one inbox
INCOMPLETE = (
    f"It is incomplete: {SECRET}, which nbgrader writes last, is missing or empty. Either it is still "
    "being copied, or the disk was full when the student submitted."
)

Owner = Callable[[str], int]


@dataclass(frozen=True)
class Submission:
    """One submission in an inbox."""

    folder: Path
    student: str
    assignment: str
    time: datetime
    key: str

    def name(self, time: datetime) -> str:
        """The name of its folder in the exchange, as of this time."""
        return f"{self.student}+{self.assignment}+{time.strftime(FORM)}+{self.key}"


def import_submissions(inboxes: Path, course: str, inbound: Path, owner: Owner | None = None) -> list[str]:
    """Copy what is new in all inboxes into nbgrader's folder; returns what was left out, and why.

    owner: the number of the Unix user who must own a student's files; by default of that name.
    """
    owner = owner or _unix_user
    notices = []
    for inbox in sorted(path for path in inboxes.iterdir() if (path / course / "inbound").is_dir()):
        student = inbox.name
        try:
            user = owner(student)
            for folder in _waiting(inbox / course / "inbound"):
                notices += _import(folder, student, user, inbound)
        except KeyError:
            notices.append(f"{student}: there is no Unix user of this name")
        except OSError as error:
            notices.append(f"{student}: the inbox can't be read ({error.strerror})")
    return notices


def _unix_user(student: str) -> int:
    return pwd.getpwnam(student).pw_uid


def _waiting(inbound: Path) -> Iterator[Path]:
    names = sorted(os.listdir(inbound))
    yield from (inbound / name for name in names[-MAX_WAITING:])


def _import(folder: Path, student: str, user: int, inbound: Path) -> list[str]:
    try:
        submission = _submission(folder, student)
        if list(inbound.glob(f"{student}+*+{submission.key}")):
            return []
        late = _copy(submission, user, inbound)
    except (Unusable, OSError, ValueError) as error:
        return [f"{student}: {quote(folder.name)} is left out. {error}"]
    if late:
        shown = submission.time.strftime(FORM)
        return [f"{student}: {submission.assignment} of {shown} was changed at {late}, and that time counts."]
    return []


def _submission(folder: Path, student: str) -> Submission:
    match = NAME.fullmatch(folder.name)
    if not match:
        raise Unusable("Expected a name as `nbgrader submit` makes it.")
    if match["student"] != student:
        raise Unusable(f"It is in the inbox of {student}; hand in under your own name.")
    time = parse_utc(match["time"]).replace(tzinfo=UTC)
    return Submission(folder, student, match["assignment"], time, match["key"])


def _copy(submission: Submission, user: int, inbound: Path) -> str:
    """Copy a submission, whole or not at all; returns the time of its last change if that is what counts."""
    partial = inbound / f".{submission.key}.part"
    shutil.rmtree(partial, ignore_errors=True)
    partial.mkdir(mode=0o700)
    try:
        changed = _copy_files(submission.folder, user, partial)
        late = changed - submission.time > TOLERANCE
        time = changed if late else submission.time
        (partial / TIMESTAMP).write_text(time.strftime(FORM), encoding="utf-8")
        partial.rename(inbound / submission.name(time))
    finally:
        shutil.rmtree(partial, ignore_errors=True)
    return time.strftime(FORM) if late else ""


def _copy_files(folder: Path, user: int, target: Path) -> datetime:
    entries = list_entries(folder)
    if odd := [entry for entry in entries if entry.kind not in (FILE, FOLDER)]:
        raise Unusable(f"{quote(odd[0].path)} is {odd[0].kind}; hand in files and folders only.")
    files = [entry for entry in entries if entry.kind == FILE]
    if not any(entry.path == SECRET and entry.size for entry in files):
        raise Unusable(INCOMPLETE)
    size = sum(entry.size for entry in files)
    if len(files) > MAX_FILES or size > MAX_BYTES:
        raise Unusable(
            f"It has {len(files)} files and {size / 1e6:.0f} MB; at most {MAX_FILES} files and "
            f"{MAX_BYTES / 1e6:.0f} MB can be handed in."
        )
    newest = os.lstat(folder).st_ctime
    for entry in files:
        seen = os.lstat(folder / entry.path)
        if seen.st_uid != user:
            raise Unusable(f"{quote(entry.path)} belongs to another user; hand in files of your own.")
        newest = max(newest, seen.st_ctime)
        (target / entry.path).parent.mkdir(parents=True, exist_ok=True)
        (target / entry.path).write_bytes(read_file(folder, entry.path, MAX_BYTES))
    return datetime.fromtimestamp(newest, UTC)
