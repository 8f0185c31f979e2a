"""The folder work/: a student's copies of lessons and exercises, not modified by git or `make exercises`.

`make lab` opens this folder. Unmodified files are updated; modified ones are kept, and the new version is
saved next to them. Where many users share one course that only its owner can change, as on a hub, the folder
is in each user's home.
"""

import hashlib
import json
import os
import shutil
from contextlib import suppress
from pathlib import Path

from grader.notebook_format import InvalidNotebook, normalized

FOLDER = "work"
FOLDER_IN_HOME = "ros2-course"
SOURCES = ("course", "exercises")
ASSISTANT_FILES = ("AGENTS.md", "TUTOR.md")  # of course/
RECORD = ".given.json"  # path -> digest of the last copied version
GENERATED = ("__pycache__", ".ipynb_checkpoints", "my_*", "test_my_*", "ws", "predictions.json")


def find_work_folder(course: Path) -> Path:
    """Where the student's copies are: in the course's folder, or in the home if that can't be changed."""
    if os.access(course, os.W_OK):
        return course / FOLDER
    return Path.home() / FOLDER_IN_HOME


def update_work_folder(course: Path) -> list[str]:
    """Create or update the student's copies.

    Returns a sentence for each modified file whose new version was saved next to it.
    """
    work = find_work_folder(course)
    work.mkdir(exist_ok=True)
    record = work / RECORD
    copied = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
    notices = []
    sources = {source.relative_to(course).as_posix(): source for source in student_files(course)}
    sources |= {path.name: path for path in assistant_files(course)}
    for name, source in sources.items():
        new_version = _update(source, work / name, copied.get(name))
        if new_version:
            notices.append(
                f"There is a new version of {name}. Yours stays as it is; "
                f"the new one is {new_version.relative_to(work).as_posix()}."
            )
        copied[name] = content_digest(source)
    record.write_text(json.dumps(copied, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    return notices


def assistant_files(course: Path) -> list[Path]:
    """The rules for AI assistants, which look for them at the top of a folder."""
    return [path for name in ASSISTANT_FILES if (path := course / "course" / name).exists()]


def student_files(course: Path) -> list[Path]:
    """The files of lessons and exercises for students, sorted."""
    files = (path for folder in SOURCES for path in (course / folder).rglob("*") if path.is_file())
    return sorted(path for path in files if not _is_generated(path.relative_to(course)))


def _is_generated(path: Path) -> bool:
    return any(Path(part).match(pattern) for part in path.parts for pattern in GENERATED)


def content_digest(path: Path) -> str:
    """A digest of a file's content; of a notebook without its outputs."""
    content = path.read_bytes()
    if path.suffix == ".ipynb":
        with suppress(InvalidNotebook, UnicodeDecodeError):  # an invalid notebook: digest its bytes
            content = normalized(content.decode("utf-8"), path.name).encode()
    return hashlib.sha256(content).hexdigest()


def _update(source: Path, target: Path, copied: str | None) -> Path | None:
    """Copy a file; if the target was modified, copy it next to the target and return its path.

    copied: the digest of the last copied version.
    """
    if target.exists():
        new, own = content_digest(source), content_digest(target)
        if new in (copied, own):
            return None
        if own != copied:
            new_version = target.with_stem(f"{target.stem}-new")
            shutil.copyfile(source, new_version)
            return new_version
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)
    return None
