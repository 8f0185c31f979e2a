"""Makes the students' handout, as a folder and as a ZIP: lessons, starters, the robot and the checks.

    python -m grader.marking.release.handout [--to FOLDER]      default: dist

It has no solutions, no tests, and of marking only what a league of a student's own robots needs. Equal
courses give equal bytes.
"""
import argparse
import hashlib
import re
import shutil
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import nbformat

from grader.course_files.notebook_format import normalized
from grader.course_files.work_folder import assistant_files, student_files
from grader.marking.errors import CommandFailed
from grader.marking.judge.personal_release import has_variants
from grader.marking.release.make_exercises import differences

NAME = "ros2-course"
# Included besides lessons and exercises; parts of it are excluded below.
INCLUDED = (
    *("COLCON_IGNORE", "LICENSE", "pyproject.toml", "requirements.lock", "nbgrader_config.py"),
    *(".ci/setup", ".ci/slim", ".ci/uv.txt"),
    *("jupyter", "sim", "grader", "ros_packages", ".binder", ".devcontainer"),
)
MARKING_EXCLUDED = (
    *("command", "gradebook", "release", "secret.py", "mark_evidence.py", "self_check.py"),
    *("spreadsheet.py", "lateness.py"),
    *("extras/one_submission", "extras/dask_cluster", "extras/hub", "extras/learning_platform"),
    *("extras/likeness", "extras/platforms", "extras/receipts", "extras/own_notebooks"),
)
PARTS = "ros_packages/python", "sim", "grader", "grader/marking", "grader/marking/extras"
EXCLUDED = (
    *(f"grader/marking/{part}" for part in MARKING_EXCLUDED),
    *(f"{part}/pyproject.toml" for part in PARTS),  # for tests of each part alone
    *("jupyter/teach", "jupyter/hub", "course/README.md"),
    *("grader/README.md", "grader/YOUR_FIRST_EXERCISE.md"),
)
ANSWERS = re.compile(r"grader/exercises/\w+/\w+/answers\.py")  # an exercise's, which students don't get
TARGETS = ("help", "lab", "setup", "clean")  # of the Makefile that are included
TOOL_FOLDERS = {"__pycache__", ".ipynb_checkpoints", "build"}
ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a ZIP can hold
TARGET = re.compile(r"^([a-z]+):", re.M)


def contents(course: Path) -> dict[str, bytes]:
    """Every file of the handout by its path in it, sorted."""
    varied = tuple(f"exercises/{name}/" for name in assignments_with_variants(course))
    files = [*student_files(course), *_files(course)]
    found = {path.relative_to(course).as_posix(): path for path in files}
    names = [name for name in found if not (_is_excluded(name) or name.startswith(varied))]
    texts = {name: _content(found[name]) for name in names}
    texts["README.md"] = (course / "course" / "README.md").read_bytes()
    texts |= {path.name: path.read_bytes() for path in assistant_files(course)}
    texts["Makefile"] = makefile((course / "Makefile").read_text(encoding="utf-8")).encode()
    return dict(sorted(texts.items()))


def assignments_with_variants(course: Path) -> list[str]:
    """The assignments that are different for each student, so that no handout has them."""
    paths = sorted((course / "exercises").glob("*/*.ipynb"))
    return sorted({path.parent.name for path in paths if has_variants([nbformat.read(path, 4)])})


def _files(course: Path) -> Iterator[Path]:
    for part in INCLUDED:
        path = course / part
        below = path.rglob("*") if path.is_dir() else [path]
        for file in below:
            inside = file.relative_to(course).parts
            left = TOOL_FOLDERS.intersection(inside) or any(part.endswith(".egg-info") for part in inside)
            if file.is_file() and not left:
                yield file


def _is_excluded(name: str) -> bool:
    excluded = any(name == part or name.startswith(f"{part}/") for part in EXCLUDED)
    return excluded or ANSWERS.fullmatch(name) is not None


def _content(path: Path) -> bytes:
    if path.suffix == ".ipynb":  # it may have outputs
        return normalized(path.read_text(encoding="utf-8"), str(path)).encode()
    return path.read_bytes()


def makefile(text: str) -> str:
    """The Makefile with the students' targets only; its rules are separated by blank lines."""
    parts = []
    for part in text.split("\n\n"):
        rule = TARGET.search(part)
        if not rule or rule[1] in TARGETS:
            parts.append(part)
    return "\n\n".join(parts).rstrip() + "\n"


def write_folder(files: dict[str, bytes], folder: Path) -> None:
    """Write the files into a folder, in place of an older handout; a student's work stays."""
    for name in {Path(name).parts[0] for name in files}:
        old = folder / name
        if old.is_dir():
            shutil.rmtree(old)
    for name, content in files.items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
        target.chmod(_mode(name))


def write_zip(files: dict[str, bytes], path: Path) -> str:
    """Write the files into a ZIP; return its SHA-256."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(f"{NAME}/{name}", ZIP_EPOCH)
            entry.create_system = 3  # Unix, so that the mode counts
            entry.external_attr = (0o100000 | _mode(name)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _mode(name: str) -> int:
    return 0o755 if name == ".ci/setup" else 0o644


def main(arguments: list[str] | None = None) -> int:
    """Run the command line in the course's folder; returns the exit status."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.handout", description="Make the students' handout."
    )
    parser.add_argument("--to", type=Path, default=Path("dist"), metavar="FOLDER", help="default: dist")
    to = parser.parse_args(arguments).to
    course = Path.cwd()
    try:
        stale = differences(course)
    except CommandFailed as error:
        print(error, file=sys.stderr)
        return 1
    if stale:
        print("\n".join([*stale, "Run `make exercises` first."]), file=sys.stderr)
        return 1
    to.mkdir(parents=True, exist_ok=True)
    files = contents(course)
    write_folder(files, to / NAME)
    digest = write_zip(files, to / f"{NAME}.zip")
    for name in assignments_with_variants(course):
        print(f"{name} has variants, so it is left out: `python -m grader variants {name}` writes it.")
    size = (to / f"{NAME}.zip").stat().st_size
    print(f"{to / NAME}/ and {to / NAME}.zip: {len(files)} files, {size / 1e6:.1f} MB, SHA-256 {digest}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
