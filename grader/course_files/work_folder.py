"""The folder work/: a student's copies of lessons and exercises, not modified by git or `make exercises`.

`make lab` opens this folder. Unmodified files are updated, and unchanged cells of a notebook keep their
outputs. Modified files are kept, and the new version is saved next to them. Where many users share one course
that only its owner can change, as on a hub, the folder is in each user's home.
"""

import hashlib
import json
import os
import shutil
from contextlib import suppress
from pathlib import Path
from typing import Any

from grader.course_files.notebook_format import InvalidNotebook, normalized

CHOSEN = "ROS2_COURSE_WORK"  # an environment variable: the folder that the student chose
FOLDER = "work"
FOLDER_IN_HOME = "ros2-course"
SOURCES = ("course", "exercises")
ASSISTANT_FILES = ("AGENTS.md", "TUTOR.md")  # of course/
RECORD = ".given.json"  # path -> digest of the last copied version
UPDATED = ".updated.txt"  # a sentence for each notebook that was run and that the last update changed
GENERATED = ("__pycache__", ".ipynb_checkpoints", "my_*", "test_my_*", "ws", "predictions.json")


def find_work_folder(course: Path) -> Path:
    """Return where the student's copies are: as the student chose, in the course's folder, or in the home."""
    if chosen := os.environ.get(CHOSEN):
        return Path(chosen)
    if os.access(course, os.W_OK):
        return course / FOLDER
    return Path.home() / FOLDER_IN_HOME


def update_work_folder(course: Path) -> list[str]:
    """Create or update the student's copies.

    Returns a sentence for each modified file whose new version was saved next to it, and for each notebook
    that was run and is updated.
    """
    work = find_work_folder(course)
    work.mkdir(parents=True, exist_ok=True)
    record = work / RECORD
    copied = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
    notices, renewed = [], []
    sources = {source.relative_to(course).as_posix(): source for source in student_files(course)}
    sources |= {path.name: path for path in assistant_files(course)}
    for name, source in sources.items():
        match _update(source, work / name, copied.get(name)):
            case Path() as new_version:
                notices.append(
                    f"There is a new version of {name}. Yours stays as it is; "
                    f"the new one is {new_version.relative_to(work).as_posix()}."
                )
            case str(what) if what:
                renewed.append(f"{name} was updated: {what}")
        copied[name] = content_digest(source)
    (work / UPDATED).write_text("".join(f"{sentence}\n" for sentence in renewed), encoding="utf-8")
    record.write_text(json.dumps(copied, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    return notices + renewed


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


def _update(source: Path, target: Path, copied: str | None) -> Path | str:
    """Copy a file; if the target was modified, copy it next to the target and return its path.

    copied: the digest of the last copied version. Otherwise returns what an update did to a notebook that was
    run; "" for other files.
    """
    if target.exists():
        new, own = content_digest(source), content_digest(target)
        if new in (copied, own):
            return ""
        if own != copied:
            new_version = target.with_stem(f"{target.stem}-new")
            shutil.copyfile(source, new_version)
            return new_version
        if source.suffix == ".ipynb":
            return _renew_notebook(source, target)
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)
    return ""


def _renew_notebook(source: Path, target: Path) -> str:
    """Copy a notebook; a cell of code with the same id and text keeps its outputs.

    Returns what was renewed; "" if the target was not run.
    """
    own, notebook = (json.loads(path.read_text(encoding="utf-8")) for path in (target, source))
    run = {_identity(cell): cell for cell in _code_cells(own) if cell.get("execution_count") is not None}
    code = _code_cells(notebook)
    same = [cell for cell in code if _identity(cell) in run]
    for cell in same:
        cell |= {key: run[_identity(cell)][key] for key in ("outputs", "execution_count")}
    widgets = own["metadata"].get("widgets")
    notebook["metadata"] |= {"widgets": widgets} if widgets else {}
    target.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    if not run:
        return ""
    unchanged = f"{len(same)} of its {len(code)} cells of code are unchanged and keep their outputs"
    return f"{unchanged}. Run the others."


def _code_cells(notebook: dict[str, Any]) -> list[dict[str, Any]]:
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def _identity(cell: dict[str, Any]) -> tuple[str, str]:
    return cell.get("id", ""), "".join(cell["source"])
