"""The versions of the code that marks and of its libraries, on which grades may depend."""

import ast
import functools
import hashlib
import json
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from importlib import metadata
from pathlib import Path

from grader.marking.atomic_file import write_atomically
from sim.course_folders import COURSE, FILES, ROS_PACKAGES
from sim.distro import RCLPY_DISTRIBUTION

CODE = COURSE / "grader", COURSE / "sim", ROS_PACKAGES  # the last has tf2_ros and launch
# What is compiled differs from machine to machine, and is made of sources that are here.
BUILT = {"__pycache__", "build", "ros2_course_lidar.egg-info"}
# Pages, their scripts and manuals change no mark.
SHOWN_ONLY = {".md", ".html", ".j2", ".css", ".js"}
# Nor do these: no process that judges or is judged imports them.
MARKING: tuple[str, ...] = ("command", "gradebook", "release", "extras", "journal.py", "lateness.py")
MARKING += ("mark_evidence.py", "version.py")
APART = {*(f"grader/marking/{name}" for name in MARKING), "grader/__main__.py"}
APART |= {*(f"grader/course_files/{name}.py" for name in ("review_questions", "work_folder"))}
APART |= {"sim/__main__.py", "sim/standalone"}
LOCK = "requirements.lock"  # the file with the version of every library
LIBRARIES = (RCLPY_DISTRIBUTION, "numpy", "pymunk", "ipython", "matplotlib")
KNOWN = Path(__file__).with_name("__pycache__") / "versions.json"
FEW = 4  # states of the files that are remembered
Documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


@functools.cache
def code_version(also: str = "") -> str:
    """A digest of all code that can change a mark: when it changes, submissions are marked again.

    also: a folder that counts in addition. Comments and docstrings don't count, except the docstrings of
    checks, which students read. Computed once for each state of the files.
    """
    files = {name: path.read_bytes() for name, path in sorted(_files(also))}
    plain = _digest(files.items(), repr(sys.version_info[:2]))
    known: dict[str, str] = {}
    with suppress(OSError, ValueError):
        known = json.loads(KNOWN.read_text())
    if plain in known:
        return known[plain]
    found = _digest((name, meaning(data) if name.endswith(".py") else data) for name, data in files.items())
    with suppress(OSError):
        write_atomically(KNOWN, json.dumps(dict([*known.items(), (plain, found)][-FEW:])) + "\n")
    return found


def meaning(source: bytes) -> bytes:
    """A Python module without what changes nothing: its syntax tree without comments and most docstrings."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, Documented) and not getattr(node, "decorator_list", ()) and _has_docstring(node):
            del node.body[0]
    return ast.dump(tree).encode()


def lock_digest() -> str:
    """SHA-256 of the lock file."""
    return hashlib.sha256((FILES / LOCK).read_bytes()).hexdigest()


def course_version() -> str:
    """The version of the course for people: the beginning of its digest."""
    return code_version()[:12]


def versions() -> dict[str, str]:
    """The versions of the course, of Python and of the libraries that a grade depends on, by name."""
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    return {"course": course_version(), "Python": python, **{it: metadata.version(it) for it in LIBRARIES}}


def _files(also: str) -> Iterator[tuple[str, Path]]:
    """The files that can change a mark, with their names in the course."""
    for package, path in ((folder, path) for folder in CODE for path in folder.rglob("*")):
        name = path.relative_to(package.parent)
        folders = {str(folder) for folder in (name, *name.parents)}
        counts = not APART & folders or also in folders
        if counts and path.is_file() and not BUILT & {*name.parts} and path.suffix not in SHOWN_ONLY:
            yield str(name), path


def _has_docstring(node: Documented) -> bool:
    return bool(node.body) and ast.get_docstring(node, clean=False) is not None


def _digest(parts: Iterable[tuple[str, bytes]], first: str = "") -> str:
    digest = hashlib.sha256(first.encode())
    for part in (part for name, data in parts for part in (name.encode(), data)):
        digest.update(len(part).to_bytes(8) + part)
    return digest.hexdigest()
