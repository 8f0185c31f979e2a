"""Collects a release in dist/release/: wheels, handout, notebooks for services, checksums and notes.

    python -m grader.marking.release.make_release [--tag TAG] [--site FOLDER]

`make release` builds the wheels first. Equal courses give equal bytes.
"""
import argparse
import hashlib
import re
import shutil
import sys
import tomllib
from pathlib import Path
from typing import Any

from grader.marking.errors import CommandFailed
from grader.marking.release import handout
from grader.marking.release.make_exercises import differences
from grader.marking.release.service_notebooks import PublishedRelease, published, service_notebooks

CHANGES = Path(".ci", "CHANGELOG.md")
WHEELS = Path("wheels")
RELEASE = Path("dist", "release")
NOTEBOOKS = Path("dist", "notebooks")  # the content of the branch that services open
VERSIONED = (Path("ros_packages/interfaces"), Path("sim/world/rays"))  # of what is compiled
NOTES = """{changes}

## Installation

On Linux x86_64 with Python 3.11 to 3.14, without a compiler:

```
pip install {wheels}
ros2-course copy    # or, with `pip install 'ros2-notebook-course[lab]'`, ros2-course lab
```

`ros2-course.zip` is what students get; `SHA256SUMS` has the checksums of all files.
"""


def version(course: Path) -> str:
    """The version of the course. Raises CommandFailed if what it compiles has another one."""
    project = _project(course)
    found: str = project["version"]
    for folder in VERSIONED:
        other = _project(course / folder)
        pin = f"{other['name']}=={found};"
        if other["version"] != found or not any(each.startswith(pin) for each in project["dependencies"]):
            raise CommandFailed(
                f"The course is {found}, and {other['name']} is {other['version']}: set the version and the "
                f"dependency in pyproject.toml and the version in {folder}/pyproject.toml to the same number."
            )
    return found


def _project(folder: Path) -> Any:
    return tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def changes(course: Path, number: str) -> str:
    """The changelog's section of a version. Raises CommandFailed if there is none."""
    text = (course / CHANGES).read_text(encoding="utf-8")
    found = re.search(rf"^## {re.escape(number)}\b[^\n]*\n(.*?)(?=^## |\Z)", text, re.M | re.S)
    if not found or not found[1].strip():
        raise CommandFailed(f"{CHANGES} says nothing about {number}: add a section `## {number}`.")
    return found[1].strip()


def make_release(course: Path, tag: str = "", site: Path | None = None) -> list[Path]:
    """Write the release; returns its files, sorted. Raises CommandFailed, ValueError for a wrong address.

    tag: of the commit, "" for none. site: a folder that `make site` made, to be published as a ZIP.
    """
    number = version(course)
    if tag not in ("", f"v{number}"):
        raise CommandFailed(f"The tag is {tag}, and pyproject.toml has version {number}: tag it v{number}.")
    notes = changes(course, number)
    wheels = sorted((course / WHEELS).glob("ros2_*.whl"))
    if len(wheels) != 1 + len(VERSIONED):
        raise CommandFailed("wheels/ does not have the three wheels of the course: run `make release`.")
    if stale := differences(course):
        raise CommandFailed("\n".join([*stale, "Run `make exercises` first."]))
    _write(course, number, wheels, site)
    target = course / RELEASE
    sums = [
        f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in sorted(target.iterdir())
    ]
    (target / "SHA256SUMS").write_text("".join(sums), encoding="utf-8")
    addresses = _addresses(published(course), number, wheels)
    (target / "NOTES.md").write_text(NOTES.format(changes=notes, wheels=addresses), encoding="utf-8")
    return sorted(target.iterdir())


def _write(course: Path, number: str, wheels: list[Path], site: Path | None) -> None:
    """Write the files that have checksums."""
    target, release = course / RELEASE, published(course)
    addresses = _addresses(release, number, wheels)
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    for wheel in wheels:
        shutil.copyfile(wheel, target / wheel.name)
    handout.write_zip(handout.contents(course), target / "ros2-course.zip")
    _write_notebooks(course, release, addresses)
    if site:
        pages = {path.relative_to(site).as_posix(): path for path in site.rglob("*") if path.is_file()}
        contents = {name: path.read_bytes() for name, path in sorted(pages.items())}
        handout.write_zip(contents, target / "ros2-course-site.zip")


def _addresses(release: PublishedRelease | None, number: str, wheels: list[Path]) -> str:
    """The wheels as arguments of pip: where they are published, or here."""
    folder = f"{release.address}/releases/download/v{number}/" if release else "./"
    return " ".join(f"{folder}{wheel.name}" for wheel in wheels)


def _write_notebooks(course: Path, release: PublishedRelease | None, wheels: str) -> None:
    """Write the notebooks for services, a folder and a ZIP, if the release has an address."""
    shutil.rmtree(course / NOTEBOOKS, ignore_errors=True)
    if release:
        files = service_notebooks(course, PublishedRelease(release.address, wheels))
        handout.write_zip(files, course / RELEASE / "ros2-course-notebooks.zip")
        for name, content in files.items():
            path = course / NOTEBOOKS / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def main(arguments: list[str] | None = None) -> int:
    """Run the command line in the course's folder; returns the exit status."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.make_release", description="Collect a release in dist/release/."
    )
    parser.add_argument("--tag", default="", help="the tag of the commit, which must be v and the version")
    parser.add_argument("--site", type=Path, metavar="FOLDER", help="add the site that `make site` built")
    options = parser.parse_args(arguments)
    try:
        files = make_release(Path.cwd(), options.tag, options.site)
    except (CommandFailed, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    size = sum(path.stat().st_size for path in files) / 1e6
    print(f"{RELEASE}/: {', '.join(path.name for path in files)}, {size:.1f} MB")
    if not published(Path.cwd()):
        print("Without `release` in pyproject.toml there are no notebooks for services such as Colab.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
