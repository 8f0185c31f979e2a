"""The Unix users of a hub, who are its users."""
import csv
import grp
import os
import pwd
import secrets
import subprocess
from pathlib import Path

from grader.marking.errors import CourseError
from grader.marking.extras.hub.hub_settings import HubSettings, grader_of

FIRST_UID = 1000  # smaller ones are the system's
PASSWORDS = "passwords.csv"


def problems(settings: HubSettings) -> list[str]:
    """A sentence for each existing user who can't be a user of the hub."""
    found = []
    for name in [*settings.students, *settings.teachers]:
        try:
            user = pwd.getpwnam(name)
        except KeyError:
            continue
        if user.pw_uid < FIRST_UID:
            found.append(f"{name} is a user of the system (number {user.pw_uid}): choose another name")
            continue
        group = grp.getgrgid(user.pw_gid).gr_name
        if name in settings.students and group != name:
            found.append(
                f"the group of {name} is {group}, and others may be in it: give {name} a group, with "
                f"`groupadd {name} && usermod -g {name} {name}`"
            )
        home = Path(user.pw_dir)
        if home.exists() and home.stat().st_mode & 0o077:
            found.append(f"others can enter the home of {name}: run `chmod 700 {home}`")
    return found


def create_missing(settings: HubSettings) -> list[str]:
    """Create missing users; returns their names. Their passwords are in a file that only root reads."""
    created = [name for name in [*settings.students, *settings.teachers] if _create(name)]
    for course in settings.courses:
        _create(grader_of(course), "--home-dir", str(settings.home(course)), "--shell", "/usr/sbin/nologin")
    if created:
        _give_passwords(created, settings.folder / PASSWORDS)
    return created


def _create(name: str, *options: str) -> bool:
    try:
        pwd.getpwnam(name)
        return False
    except KeyError:
        _run("useradd", "--create-home", "--user-group", *(options or ("--shell", "/bin/bash")), name)
        os.chmod(pwd.getpwnam(name).pw_dir, 0o700)
        return True


def _give_passwords(names: list[str], file: Path) -> None:
    passwords = {name: secrets.token_urlsafe(9) for name in names}
    _run("chpasswd", text="".join(f"{name}:{word}\n" for name, word in passwords.items()))
    descriptor = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW, 0o600)
    with os.fdopen(descriptor, "a", encoding="utf-8") as stream:
        csv.writer(stream).writerows(passwords.items())


def _run(*command: str, text: str | None = None) -> None:
    done = subprocess.run(command, input=text, text=True, capture_output=True)
    if done.returncode:
        raise CourseError(f"`{' '.join(command)}` failed: {done.stderr.strip()}")
