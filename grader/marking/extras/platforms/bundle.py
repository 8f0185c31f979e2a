"""The files of an autograder on any platform: the course with what judges, wheels, release, settings."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping, Set
from dataclasses import asdict, dataclass
from pathlib import Path

from grader.marking.errors import CourseError
from grader.marking.extras.platforms.core_packages import COMPILED, pinned_requirements

FILES = Path(__file__).with_name("files")
COURSE_FILES = ("LICENSE", "requirements.lock", "pyproject.toml")
COURSE_FOLDERS = ("sim", "grader", "ros_packages/python", "ros_packages/interfaces/build_tools")
LEAGUE = "league"
LEFT_OUT = {"__pycache__", "build", "rays", "hub", LEAGUE, "learning_platform", "dask_cluster", "web"}
KEPT = {"sim/view/web"}
BUILDS = "colcon build", '.grade("ws"'  # in the notebooks of an assignment whose packages are built
SETTINGS, SECRET = "settings.json", ".secret"


@dataclass(frozen=True)
class PlatformSettings:
    """The settings of an autograder. exercises: only these, if any. seconds: for the cells of a notebook.

    visibility: of tests, as Gradescope names it. percent_per_day: of its points that a late day costs.
    league: the robot also works in the league's warehouses, for Gradescope's leaderboard.
    """

    assignment: str
    exercises: tuple[str, ...] = ()
    seconds: float = 480.0
    visibility: str = "visible"
    percent_per_day: float = 0.0
    league: bool = False

    @staticmethod
    def read(folder: Path) -> PlatformSettings:
        """Read the settings of a bundle."""
        data = json.loads((folder / SETTINGS).read_text(encoding="utf-8"))
        return PlatformSettings(**{**data, "exercises": tuple(data["exercises"])})


def bundle(course: Path, settings: PlatformSettings, secret: str) -> dict[str, bytes]:
    """The files of an autograder by path, without those of a platform. Raises CourseError, OSError.

    secret: private worlds and seeds are derived from it; "" for the public ones.
    """
    release = course / "exercises" / settings.assignment
    if not any(release.glob("*.ipynb")):
        raise CourseError(f"expected an assignment in {release}, saw no notebook: run `make exercises` first")
    files = {f"course/{name}": (course / name).read_bytes() for name in COURSE_FILES}
    for path in _course_files(course, LEFT_OUT - {LEAGUE} if settings.league else LEFT_OUT):
        files[f"course/{path.relative_to(course).as_posix()}"] = path.read_bytes()
    for path in sorted(each for each in release.rglob("*") if each.is_file()):
        files[f"release/{settings.assignment}/{path.relative_to(release).as_posix()}"] = path.read_bytes()
    for wheel in _compiled_wheels(course):
        files[f"wheels/{wheel.name}"] = wheel.read_bytes()
    needed = pinned_requirements(course, _builds_packages(release))
    files["requirements.txt"] = needed.encode()
    files["install.sh"] = (FILES / "install.sh").read_bytes()
    files[SETTINGS] = (json.dumps(asdict(settings), indent=1) + "\n").encode()
    if secret:
        files[SECRET] = f"{secret}\n".encode()
    return dict(sorted(files.items()))


def _course_files(course: Path, left_out: Set[str]) -> Iterator[Path]:
    for folder in COURSE_FOLDERS:
        for path in sorted((course / folder).rglob("*")):
            inside = path.relative_to(course)
            kept = any(inside.is_relative_to(name) for name in KEPT)
            if path.is_file() and (kept or not left_out & set(inside.parts)):
                yield path


def _compiled_wheels(course: Path) -> list[Path]:
    """The wheels of what is compiled, as `make wheels` builds them. Raises CourseError."""
    found = []
    for name in COMPILED:
        wheels = sorted((course / "wheels").glob(f"{name.replace('-', '_')}-*.whl"))
        if not wheels:
            raise CourseError(f"expected the wheel of {name} in wheels/, saw none: run `make wheels` first")
        found += wheels
    return found


def _builds_packages(release: Path) -> bool:
    texts = [path.read_text(encoding="utf-8").replace('\\"', '"') for path in release.glob("*.ipynb")]
    return any(sign in text for text in texts for sign in BUILDS)


def mode_of(name: str) -> int:
    """The mode of a file in a bundle: programs can be executed, the secret is root's alone."""
    if name == SECRET:
        return 0o600
    return 0o755 if name.endswith(".sh") or Path(name).name in ("run_autograder", "autograder.py") else 0o644


def write_folder(files: Mapping[str, bytes], folder: Path) -> None:
    """Write a bundle into a folder, in place of an older one. Raises OSError."""
    shutil.rmtree(folder, ignore_errors=True)
    for name, content in files.items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.touch(mode=mode_of(name))
        target.write_bytes(content)
        target.chmod(mode_of(name))
