"""Puts the uploads of an archive into class/submitted/, for the students whom they belong to."""
import re
import shutil
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from grader.marking.errors import CourseError
from grader.marking.extras.learning_platform.archive import UnusableEntry, open_archive
from grader.marking.extras.learning_platform.known_students import known_students
from grader.marking.extras.learning_platform.platform_users import PlatformUser, match_users
from grader.marking.extras.learning_platform.upload_names import NamedUpload, first_name
from grader.marking.extras.learning_platform.uploads import PersonalUpload, sort_uploads
from grader.marking.gradebook.collected_uploads import CollectedUpload, read_collected, write_collected
from grader.marking.gradebook.course import Course, write_timestamp
from grader.marking.submission.submitted_files import IGNORED_FILES

UNSAFE = re.compile(r"[^\w@.'() -]")  # in the name of a folder, which nbgrader shows on its pages
ASIDE = ".collecting"
WITH_SHEET = "give the platform's grading sheet with --moodle or --canvas"


@dataclass
class CollectReport:
    """A report on a collection: the students, and sentences on what the instructor should know or do."""

    new: list[str] = field(default_factory=list)
    replaced: list[str] = field(default_factory=list)
    unchanged: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)


def assignment_of(course: Course, archive: Path) -> str:
    """The assignment whose notebooks' names are in an archive. Raises CourseError, OSError."""
    names = {name: _notebooks(course, name) for name in course.assignments()}
    paths = [entry.path for entry in open_archive(archive)]
    found = [
        name
        for name, books in names.items()
        if any(first_name(path, books)[0].endswith(tuple(books)) for path in paths)
    ]
    if len(found) != 1:
        saw = f"those of {' and '.join(found)}" if found else "none"
        raise CourseError(
            f"expected the notebooks of one assignment in {archive}, saw {saw}: give --assignment NAME"
        )
    return found[0]


def collect(
    course: Course,
    assignment: str,
    archive: Path,
    roster: Mapping[str, PlatformUser] | None = None,
    times: Mapping[str, datetime] | None = None,
) -> CollectReport:
    """Collect an archive. Raises CourseError, OSError.

    roster, times: the people of a grading sheet, and when they handed in (UTC), by number.
    """
    if assignment not in course.assignments():
        known = ", ".join(course.assignments())
        raise CourseError(f"there is no assignment {assignment}: there are {known}")
    report = CollectReport()
    uploads = sort_uploads(open_archive(archive), _notebooks(course, assignment), report.notes)
    if not uploads:
        saw = "; ".join(report.notes[:3]) or "it is empty"
        raise CourseError(f"no file in {archive} can be used: {saw}")
    stored = read_collected(course, assignment)
    for student, upload in _students(course, assignment, uploads, roster or {}, report).items():
        now, before = _collected(upload.newest, times or {}), stored.get(student, CollectedUpload())
        if now.is_older(before):
            report.notes.append(f"{student}: this upload is older than the one that was collected before")
            continue
        try:
            folder = course.submitted(student, assignment)
            _place(folder, upload.read(), student, report)
        except UnusableEntry as error:
            report.problems.append(f"{student}: the upload of {upload.person.label} {error}")
            continue
        stored[student] = now
        if now.time:
            write_timestamp(folder, datetime.fromisoformat(now.time))
        elif now.late:
            report.notes.append(f"{student}: handed in late, as the platform says")
    write_collected(course, assignment, stored)
    return report


def _collected(named: NamedUpload, times: Mapping[str, datetime]) -> CollectedUpload:
    number = named.person.number
    time = times[number].isoformat() if number in times else ""
    return CollectedUpload(number, named.lasting, named.attempt, named.feedback, named.late, time)


def _notebooks(course: Course, assignment: str) -> list[str]:
    return [path.name for path in sorted(course.release(assignment).glob("*.ipynb"))]


def _students(
    course: Course,
    assignment: str,
    uploads: Sequence[PersonalUpload],
    roster: Mapping[str, PlatformUser],
    report: CollectReport,
) -> dict[str, PersonalUpload]:
    """The upload of each student; new students get an id of what the platform says."""
    people = [roster.get(each.person.number, each.person) for each in uploads]
    known = known_students(course, assignment)
    matches = match_users(people, known)
    ids = {at: matches.found.get(at) or _new_id(people[at], each) for at, each in enumerate(uploads)}
    counts = Counter(ids.values())
    found: dict[str, PersonalUpload] = {}
    for at, person in enumerate(people):
        if at in matches.ambiguous:
            saw = f"may be {' or '.join(matches.ambiguous[at])}"
        elif counts[ids[at]] > 1:
            saw = f"there are several {ids[at]}"
        elif at not in matches.found and ids[at] in {each.student for each in known}:
            saw = f"would be {ids[at]}, which is another student"
        else:
            found[ids[at]] = uploads[at]
            continue
        report.problems.append(f"{person.label}: {saw}, and is not collected: {WITH_SHEET}")
    return found


def _new_id(person: PlatformUser, upload: PersonalUpload) -> str:
    """An id for a new student: the mail or another id of the grading sheet, or what the archive says."""
    mails = [each for each in person.ids if "@" in each]
    chosen = next(each for each in (*mails, *person.ids, upload.newest.new_id) if each)
    return UNSAFE.sub("_", chosen).strip(" .") or "student"


def _place(folder: Path, contents: dict[str, bytes], student: str, report: CollectReport) -> None:
    """Write a submission in place of an older one. Raises OSError."""
    if folder.is_dir() and _is_equal(folder, contents):
        report.unchanged.append(student)
        return
    aside = folder.with_name(ASIDE)
    shutil.rmtree(aside, ignore_errors=True)
    for path, data in contents.items():
        file = aside / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    (report.replaced if folder.exists() else report.new).append(student)
    shutil.rmtree(folder, ignore_errors=True)
    aside.rename(folder)


def _is_equal(folder: Path, contents: dict[str, bytes]) -> bool:
    paths = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}
    for name in IGNORED_FILES:
        paths.pop(name, None)
    return paths.keys() == contents.keys() and all(
        path.read_bytes() == contents[name] for name, path in paths.items()
    )
