"""`python -m grader platform PLATFORM ASSIGNMENT`: writes the autograder of an assignment for a platform."""

import argparse
import hashlib
import json
import sys
import zipfile
from collections.abc import Mapping
from pathlib import Path

from grader.marking import secret
from grader.marking.errors import CourseError
from grader.marking.extras.one_submission.judge_one import read_release
from grader.marking.extras.platforms import prairielearn
from grader.marking.extras.platforms.bundle import (
    FILES,
    SECRET,
    PlatformSettings,
    bundle,
    mode_of,
    write_folder,
)
from grader.marking.extras.platforms.common_tests import require_known_variants
from grader.marking.extras.platforms.gradescope import VISIBILITIES
from grader.marking.extras.platforms.leaderboard import require_capstone

DESCRIPTION = """Write the autograder of an assignment, which judges as `python -m grader mark-one` does.

For gradescope it is a ZIP to upload, for classroom50 a folder to put into its autograders/ASSIGNMENT, and for
prairielearn a folder to build an image of."""
OWN = {  # the files of each platform
    "gradescope": ("setup.sh", "run_autograder"),
    "classroom50": ("autograder.py",),
    "prairielearn": ("Dockerfile", "entrypoint.sh"),
}
ZIP_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a ZIP can hold
USUAL = PlatformSettings("")


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    form = argparse.RawDescriptionHelpFormatter
    made = argparse.ArgumentParser("python -m grader platform", description=DESCRIPTION, formatter_class=form)
    add = made.add_argument
    add("platform", choices=list(OWN))
    add("assignment", metavar="ASSIGNMENT", help="such as 02_topics")
    add("--to", type=Path, default=Path("dist"), metavar="FOLDER", help="default: dist")
    add("--exercise", action="append", default=[], metavar="NAME", help="only this one; may be given again")
    add("--seconds", type=float, default=USUAL.seconds, metavar="N", help="for a notebook; default: 480")
    shown = "when students see the tests of gradescope; default: visible"
    add("--visibility", choices=VISIBILITIES, default=USUAL.visibility, help=shown)
    percent = "points that a late day costs, by gradescope's due date; default: 0"
    add("--percent-per-day", type=float, default=0.0, metavar="PERCENT", help=percent)
    league = "gradescope's leaderboard: the robot also works in ten warehouses, the same for all students"
    add("--league", action="store_true", help=league)
    add("--public-worlds", action="store_true", help="leave the secret out: seeds are the public ones")
    return made


def main(arguments: list[str] | None = None) -> int:
    """Run the command in the course's folder; returns the exit status."""
    form = parser()
    options = form.parse_args(arguments)
    if options.league and options.platform != "gradescope":
        form.error(f"{options.platform} has no leaderboard, which --league is for: leave it out")
    settings = PlatformSettings(
        options.assignment,
        tuple(options.exercise),
        options.seconds,
        options.visibility,
        options.percent_per_day,
        options.league,
    )
    public = options.public_worlds or options.platform == "classroom50"  # its files are published
    try:
        if options.league:
            require_capstone(read_release(Path("exercises", options.assignment)))
        require_known_variants(Path.cwd(), options.assignment, options.platform, not public)
        files = bundle(Path.cwd(), settings, "" if public else secret.read(Path.cwd()))
        files |= {name: (FILES / name).read_bytes() for name in OWN[options.platform]}
        where = _write(options.platform, files, options.to, settings)
    except CourseError as error:
        print(f"No autograder: {error}.", file=sys.stderr)
        return 1
    except OSError as error:
        what = error.filename or "a file"
        print(f"No autograder: {what} could not be read or written ({error.strerror}).", file=sys.stderr)
        return 1
    size = sum(map(len, files.values())) / 1e6
    worlds = "private worlds" if SECRET in files else "public worlds"
    print(f"{where}: {len(files)} files, {size:.1f} MB, {worlds}")
    return 0


def _write(platform: str, files: dict[str, bytes], to: Path, settings: PlatformSettings) -> str:
    name = f"{platform}-{settings.assignment}"
    to.mkdir(parents=True, exist_ok=True)
    if platform == "gradescope":
        path = to / f"{name}.zip"
        digest = write_zip(files, path)
        return f"{path}, SHA-256 {digest}"
    if platform == "prairielearn":
        info = prairielearn.info(f"YOUR-REGISTRY/{name}", settings.seconds)
        files["info.json"] = (json.dumps(info, indent=2) + "\n").encode()
    write_folder(files, to / name)
    return str(to / name)


def write_zip(files: Mapping[str, bytes], path: Path) -> str:
    """Write the files into a ZIP, which only its owner reads; return its SHA-256. Raises OSError."""
    path.unlink(missing_ok=True)
    path.touch(mode=0o600)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, ZIP_EPOCH)
            entry.create_system = 3  # Unix, so that the mode counts
            entry.external_attr = (0o100000 | mode_of(name)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return hashlib.sha256(path.read_bytes()).hexdigest()
