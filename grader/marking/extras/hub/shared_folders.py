"""The folders of a hub outside the homes, with owners and modes that keep users apart.

    exchange/courses/COURSE/     nbgrader's exchange as teachers use it; students read what is released there
    exchange/students/COURSE/STUDENT/
                                 nbgrader's exchange as one student uses it: no other user enters it but the
                                 course's grader, who owns it; what is released is a link into the first
    courses/COURSE/              the home of the grader, with the course and its solutions
    run/USER/, certificates/USER/, hub/
"""
import os
import pwd
from pathlib import Path

from grader.marking.extras.hub.hub_settings import HubSettings, grader_of

ENTERED = 0o711  # others may enter, but not list


def make_folders(settings: HubSettings) -> None:
    """Make the folders that are missing, and correct owners and modes."""
    for path in (".", "exchange", "exchange/courses", "exchange/students", "courses", "run", "certificates"):
        _folder(settings.folder / path, ENTERED)
    _folder(settings.folder / "hub", 0o700)
    for course, people in settings.courses.items():
        grader = pwd.getpwnam(grader_of(course))
        _folder(settings.inboxes(course), ENTERED, grader.pw_uid, grader.pw_gid)
        _course_exchange(settings.exchange(course), course, grader)
        _folder(settings.home(course), 0o700, grader.pw_uid, grader.pw_gid)
        _folder(settings.runtime(course), 0o700, grader.pw_uid, grader.pw_gid)
        _folder(settings.certificates(course), 0o750, 0, grader.pw_gid)
        for name in people.students:
            _inbox(settings, name, course, grader.pw_uid)
    for name in [*settings.students, *settings.teachers]:
        user = pwd.getpwnam(name)
        _folder(settings.runtime(name), 0o700, user.pw_uid, user.pw_gid)
        _folder(settings.certificates(name), 0o750, 0, user.pw_gid)


def _course_exchange(place: Path, course: str, grader: pwd.struct_passwd) -> None:
    owner = grader.pw_uid, grader.pw_gid
    _folder(place, ENTERED, *owner)
    _folder(place / course, ENTERED, *owner)
    _folder(place / course / "outbound", 0o755, *owner)
    # What nbgrader would open to all. Students have folders of their own for that.
    _folder(place / course / "inbound", 0o700, *owner)
    _folder(place / course / "feedback", 0o700, *owner)


def _inbox(settings: HubSettings, student: str, course: str, grader: int) -> None:
    place, group = settings.inbox(student), pwd.getpwnam(student).pw_gid
    _folder(place, 0o1770, grader, group)  # nbgrader wants it to be writable; sticky, so what is in it stays
    _folder(place / course, 0o750, grader, group)
    _folder(place / course / "inbound", 0o770, grader, group)
    _folder(place / course / "feedback", 0o750, grader, group)
    released = place / course / "outbound"
    if not released.is_symlink():
        released.symlink_to(settings.exchange(course) / course / "outbound")


def _folder(path: Path, mode: int, user: int = 0, group: int = 0) -> None:
    """Make a folder; the folder above it can't be written by anyone but root and the grader."""
    path.mkdir(parents=True, exist_ok=True)
    os.chown(path, user, group, follow_symlinks=False)
    path.chmod(mode)
