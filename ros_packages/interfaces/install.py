"""Install what the course compiles into the Python that runs this: the ROS interface packages and the lidar.

    python ros_packages/interfaces/install.py

Does nothing if the current content is installed. Otherwise the wheel comes from wheels/ (or $WHEELS), which
`make wheels` fills, or from the user's cache, or is built. A wheel's build number is a digest of its sources.
"""

import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from build_tools.content import ROOT, interfaces_digest, source_digest
from build_tools.toolchain import BuildError, require_compilers

COURSE = ROOT.parents[1]
BUILD = re.compile(r"^Build: (\S+)$", re.MULTILINE)
# Fixed times in the archive and a fixed seed make builds reproducible.
REPRODUCIBLE = {"SOURCE_DATE_EPOCH": "1704067200", "PYTHONHASHSEED": "0"}
BUILD_WHEEL = (
    "import sys; from setuptools.build_meta import build_wheel; "
    "build_wheel('dist', {'--build-option': ['--build-number', sys.argv[1]]})"
)


@dataclass(frozen=True)
class Compiled:
    """A distribution that is compiled: its name, its folder, and what messages say of it and its build."""

    name: str
    folder: Path
    about: str
    takes: str
    digest: Callable[[], str]

    def build_number(self) -> str:
        """The current content's build number; a wheel's must begin with a digit."""
        return f"1{self.digest()}"

    def installed(self) -> str | None:
        """Return the installed build number, or None."""
        try:
            text = metadata.distribution(self.name).read_text("WHEEL") or ""
        except metadata.PackageNotFoundError:
            return None
        found = BUILD.search(text)
        return found[1] if found else None

    def ready_wheel(self) -> Path | None:
        """Return the current content's wheel in wheels/ or in the cache, or None."""
        pattern = f"{self.name.replace('-', '_')}-*-{self.build_number()}-*_{platform.machine()}.whl"
        given = Path(os.environ.get("WHEELS") or COURSE / "wheels")
        return next((wheel for folder in (given, cache()) for wheel in sorted(folder.glob(pattern))), None)

    def build(self) -> Path:
        """Build the wheel outside the repository and store it in the cache; returns its path.

        Raises:
            BuildError: a tool is missing, or the build failed; the message contains the output.
        """
        require_compilers(self.about)
        with tempfile.TemporaryDirectory() as directory:
            copy = Path(directory, "package")
            shutil.copytree(
                self.folder, copy, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__")
            )
            log = Path(directory, "log")
            with log.open("w") as output:
                process = subprocess.Popen(
                    [sys.executable, "-c", BUILD_WHEEL, self.build_number()],
                    cwd=copy,
                    env={**os.environ, **REPRODUCIBLE},
                    stdout=output,
                    stderr=subprocess.STDOUT,
                )
            if print_progress(process, copy):
                raise BuildError(
                    f"{log.read_text()}\nT{self.about[1:]} could not be built; the reason is above."
                )
            (made,) = copy.glob("dist/*.whl")
            return _store(made)


def _store(made: Path) -> Path:
    """Move a wheel into the cache, in such a way that other processes never see an incomplete one."""
    wheel = cache() / made.name
    wheel.parent.mkdir(parents=True, exist_ok=True)
    partial = wheel.with_suffix(f".{os.getpid()}")
    shutil.move(made, partial)
    return partial.replace(wheel)


def cache() -> Path:
    """The folder of the wheels that were built for this user."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "ros2-course-interfaces")


def print_progress(process: subprocess.Popen, copy: Path) -> int:
    """Print each package when its compilation begins, until the build ends. Return its exit status."""
    started: set[str] = set()
    packages = len(list(copy.glob("definitions/*")))
    while True:
        try:
            return process.wait(timeout=0.5)
        except subprocess.TimeoutExpired:
            for name in sorted({folder.name for folder in copy.glob("build/temp*/objects/*")} - started):
                started.add(name)
                print(f"  {len(started)} of {packages}: {name}", flush=True)


def install(wheel: Path) -> None:
    """Install the wheel with pip, without changing any other package."""
    options = ["--no-deps", "--no-index", "--force-reinstall", "--quiet", "--root-user-action=ignore"]
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", *options, str(wheel)]
    subprocess.run(pip, check=True)


INTERFACES = Compiled(
    "ros2-course-interfaces", ROOT, "the ROS interfaces", "half a minute", interfaces_digest
)
LIDAR_FOLDER = COURSE / "sim" / "world" / "rays"
LIDAR = Compiled(
    "ros2-course-lidar",
    LIDAR_FOLDER,
    "the lidar",
    "a few seconds",
    lambda: source_digest(LIDAR_FOLDER, ("*.*",)),
)
# On other machines a ROS installation provides the interfaces.
COMPILED = (INTERFACES, LIDAR) if platform.machine() == "x86_64" else (LIDAR,)


def main() -> None:
    """Install what is compiled, or exit with one sentence that says what to do."""
    try:
        for package in COMPILED:
            if package.installed() != package.build_number():
                install(package.ready_wheel() or _built(package))
    except BuildError as error:
        sys.exit(str(error))
    except KeyboardInterrupt:
        sys.exit("Stopped: what is compiled is built when the same command is run again.")


def _built(package: Compiled) -> Path:
    print(f"Building {package.about}, once; this takes {package.takes} ...", flush=True)
    return package.build()


if __name__ == "__main__":
    main()
