"""A student's own copies of lessons and exercises, in a folder that neither git nor `make exercises` writes.

`make lab` opens that folder. What a student did not change is brought up to date; what they did change stays,
and a newer version comes to lie beside it.
"""

import hashlib
import json
import shutil
from contextlib import suppress
from pathlib import Path

from grader.notebooks import BadNotebook, normalised

FOLDER = "work"
GIVEN = ("course", "exercises")
RECORD = ".given.json"  # by path: a digest of what was copied there last
LEFT_BY_TOOLS = ("__pycache__", ".ipynb_checkpoints", "my_*", "test_my_*", "ws")


def lay_out(course: Path) -> list[str]:
    """Bring course/work up to date, and make it first where there is none.

    Returns a sentence for each file that the student changed and that has a new version beside it now.
    """
    work = course / FOLDER
    work.mkdir(exist_ok=True)
    record = work / RECORD
    given = json.loads(record.read_text(encoding="utf-8")) if record.exists() else {}
    told = []
    for source in given_files(course):
        name = source.relative_to(course).as_posix()
        beside = _give(source, work / name, given.get(name))
        if beside:
            told.append(
                f"There is a new version of {name}. Yours stays as it is; "
                f"the new one is {beside.relative_to(work).as_posix()}."
            )
        given[name] = content_digest(source)
    record.write_text(json.dumps(given, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    return told


def given_files(course: Path) -> list[Path]:
    """The files of lessons and exercises that students get, sorted."""
    files = (path for folder in GIVEN for path in (course / folder).rglob("*") if path.is_file())
    return sorted(path for path in files if not _is_left_by_tools(path.relative_to(course)))


def _is_left_by_tools(path: Path) -> bool:
    return any(Path(part).match(pattern) for part in path.parts for pattern in LEFT_BY_TOOLS)


def content_digest(path: Path) -> str:
    """A digest of what somebody wrote: of a notebook without outputs, which change when it is run."""
    content = path.read_bytes()
    if path.suffix == ".ipynb":
        with suppress(BadNotebook, UnicodeDecodeError):  # broken by hand: then its bytes are what was written
            content = normalised(content.decode("utf-8"), path.name).encode()
    return hashlib.sha256(content).hexdigest()


def _give(source: Path, target: Path, given: str | None) -> Path | None:
    """Copy a file, beside the student's own where that would be lost; then return where it lies now.

    given: the digest of what was copied last.
    """
    if target.exists():
        new, own = content_digest(source), content_digest(target)
        if new in (given, own):
            return None
        if own != given:
            beside = target.with_stem(f"{target.stem}-new")
            shutil.copyfile(source, beside)
            return beside
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)
    return None
