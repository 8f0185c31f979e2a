"""What a machine lacks for marking a class, for `python -m grader mark --check`."""

import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path

from grader.marking.errors import SandboxFailed, SandboxMissing
from grader.marking.gradebook.course import Course
from grader.marking.secret import read
from grader.marking.task import TaskPool
from sim.course_folders import ROS_PACKAGES

FREE_MB = 500  # in class/ and for temporary files; each page has up to about 1 MB
BUILD_TOOLS = "gcc", "g++"


def missing(course: Course, open_pool: Callable[[], AbstractContextManager[TaskPool]]) -> Iterator[str]:
    """Yield a sentence for each thing without which a class can't be marked here: what, and how to get it.

    open_pool: opens a pool as marking does, with a self-check.
    """
    place = course.root / "class"
    if not os.access(place if place.exists() else course.root, os.W_OK):
        yield f"{place} can't be written: mark as the user who owns it"
    try:
        read(course.root)
    except SystemExit as problem:
        yield str(problem)
    for folder in (place if place.exists() else course.root, Path(tempfile.gettempdir())):
        free = shutil.disk_usage(folder).free / 1e6
        if free < FREE_MB:
            yield f"only {free:.0f} MB are free in {folder}, and marking needs {FREE_MB} MB: free some space"
    try:
        with open_pool():
            pass
    except (SandboxMissing, SandboxFailed) as problem:
        yield str(problem)


def weaknesses(course: Course) -> Iterator[str]:
    """Yield a sentence for each thing without which only a part works."""
    if lacking := [name for name in BUILD_TOOLS if not shutil.which(name)]:
        yield (
            f"there is no {' and no '.join(lacking)}, so packages of interfaces can't be built: install them "
            "with `sudo apt install build-essential`"
        )
    needed = {"this Python": Path(sys.executable).resolve(), "its packages": Path(sys.prefix)}
    needed |= {"the course": course.root, "the course's ROS packages": ROS_PACKAGES}
    for what, path in needed.items():
        if closed := _closed(path):
            yield f"{closed} is closed to other users, so only you can mark with {what}, {path}"


def _closed(path: Path) -> Path | None:
    """The topmost folder on the way to `path` that other users can't enter; None if there is none."""
    way = [*reversed(path.parents), *([path] if path.is_dir() else [])]
    return next((folder for folder in way if not folder.stat().st_mode & 0o001), None)
